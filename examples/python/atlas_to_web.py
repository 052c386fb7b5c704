"""A brain atlas as a page that turns in any browser, and as glTF for other viewers."""

import argparse
from pathlib import Path

import regionmesh

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("atlas", type=Path, help="labels, such as aal.nii.gz; names are read from a table beside it")
parser.add_argument("page", type=Path, help="page to write, .html")
parser.add_argument("--reduce", default="95%", help="share of the faces to remove")
arguments = parser.parse_args()

mesh = regionmesh.reconstruct(arguments.atlas, reduce=arguments.reduce, progress=True)
print(mesh)

title = f"<!doctype html><meta charset='utf-8'><title>{arguments.atlas.stem}</title>"
arguments.page.write_text(title + mesh._repr_html_(), encoding="utf-8")
mesh.save(arguments.page.with_suffix(".glb"))
