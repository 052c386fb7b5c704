"""Runs regionmesh for the experiments, and reads what it reports."""
import json
import pathlib
import statistics
import subprocess

AS_IN_PAPER = ("--smooth", "0", "--no-keep-samples")  # it has no test that samples stay in their regions
TAUBIN = ("--smooth-filter", "taubin")  # 20 passes: the paper smooths with filters of this kind
ALL_REGIONS = ("--no-background",)
DECIMATION = ("decimate tiles", "raise level", "decimate")  # stages of a report


class Missing(Exception):
    """A volume that an experiment needs and that is not there."""


class Lab:
    """`data`: folder of the volumes; `folder`: for models; `pictures`: where pictures go."""

    def __init__(self, program, data, folder, pictures):
        self.program, self.data = str(program), data
        self.folder, self.pictures = pathlib.Path(folder), pictures

    def volume(self, name):
        """A file of the data folder, wherever below it lies."""
        found = sorted(pathlib.Path(self.data).rglob(name)) if self.data else []
        if not found:
            raise Missing(f"{name} is not in the folder that --data names")
        return found[0]

    def at(self, name):
        return self.folder / name

    def run(self, *words):
        done = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"{' '.join(map(str, words))}: exit {done.returncode}: {done.stderr.strip() or done.stdout.strip()}")

    def reported(self, *words, key="--report"):
        path = self.at("report.json")
        self.run(*words, "--quiet", key, path)
        return json.loads(path.read_text())

    def reconstruct(self, volume, *options, model="model.vtp"):
        return self.reported("reconstruct", volume, "--cells", "tetrahedra", "-o", self.at(model), *options)

    def decimate(self, model, *options, to="decimated.vtp"):
        return self.reported("decimate", self.at(model), "-o", self.at(to), *options)

    def compare(self, a, b, *options):
        return self.reported("compare", self.at(a), self.at(b), *options, key="--json")


def race(lanes, rounds):
    """Calls functions by name in turn, round after round, backward in every second; a list of results for each."""
    results = {name: [] for name in lanes}
    for n in range(rounds):
        for name in list(lanes)[::1 if n % 2 == 0 else -1]:
            results[name].append(lanes[name]())
    return results


def seconds(report, stages=DECIMATION):
    return sum(report["seconds"].get(stage, 0) for stage in stages)


def total(report):
    """From labels to the decimated model: without check and writing, which the paper's times have apart."""
    return report["seconds"]["total"] - seconds(report, ("check", "write"))


def in_core_verdict(ratios):
    """Of the paper's claim that decimation in core takes longer than on the fly: `ratios` of their seconds."""
    return "agrees" if min(ratios) > 1 else "contradicted: it has tiles, too" if max(ratios) < 1 else "agrees in part"


def median(reports, value=total):
    return statistics.median(value(report) for report in reports)


def refused(verdicts):
    """Shares of the edges that were refused, by verdict; edges between strata are no candidates."""
    counts = {name: count for name, count in verdicts.items() if name not in ("accepted", "strata")}
    return {name: count / max(sum(counts.values()), 1) for name, count in counts.items()}
