"""Many volumes, several at a time in one process; one row of results for each, as a table."""

import argparse
import csv
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import regionmesh

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("folder", type=Path, help="folder to write models to")
parser.add_argument("volumes", type=Path, nargs="+", help="labels, any format that regionmesh reads")
parser.add_argument("--at-a-time", type=int, default=2)
arguments = parser.parse_args()
arguments.folder.mkdir(exist_ok=True)


def convert(path):
    """Make one model; an error is a result, too, so that the others go on."""
    try:
        mesh = regionmesh.reconstruct(path, reduce=0.9, threads=1)
        mesh.save(arguments.folder / f"{path.name.split('.')[0]}.vtp")
    except (ValueError, OSError) as error:
        return {"volume": path.name, "error": str(error)}
    report = mesh.report
    return {
        "volume": path.name,
        "regions": len(report["regions"]),
        "faces": len(mesh),
        "lowest quality": round(report["quality"]["min"], 3),
        "certified": mesh.certified,
        "seconds": round(report["seconds"]["total"], 2),
    }


with ThreadPoolExecutor(arguments.at_a_time) as pool:
    rows = list(pool.map(convert, arguments.volumes))
writer = csv.DictWriter(sys.stdout, ["volume", "regions", "faces", "lowest quality", "certified", "seconds", "error"])
writer.writeheader()
writer.writerows(rows)
sys.exit(any("error" in row for row in rows))
