"""Models of drill holes and of scattered points: what they cost, and how far they agree with what was logged."""
import hashlib
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import tempfile
import time

import numpy

import holes
import picture
import synthetic

ROUNDS, COUNT, PROBES = 3, 1_000_000, 20_000
DRAWN = "50%"  # of the faces of drill holes are removed

SITES = {
    "utrecht": {
        "file": "boreholes_usp_intervals.csv", "columns": holes.Columns("nr", "top", "bottom", "lith", "surface"),
        "probe": 0.1, "step": 0.5, "scale": 200, "scale_middle": 74},
    "kim": {
        "file": "kim_ready.csv", "columns": holes.Columns("name", "top", "base", "formation", "altitude"),
        "probe": 10, "step": 25, "scale": 88, "scale_middle": 6.5},
}
KIM = {  # from young to old
    "topo": "#f5e6a8", "etchegoin": "#e8c35a", "macoma": "#d9893b", "chanac": "#c9572f", "mclure": "#8fb8d9",
    "santa_margarita": "#f2a7a0", "fruitvale": "#8c6bb1", "round_mountain": "#4f86b8", "olcese": "#a8d08d",
    "freeman_jewett": "#5a9e6f", "vedder": "#c5b0d5", "eocene": "#e377c2", "cretaceous": "#3d7d7d", "basement": "#8c6d5a",
    "null": "#d8d8d8"}
UTRECHT = {"Z": ("#f2d98b", "Z sand"), "K": ("#6f9e5c", "K clay"), "V": ("#7a5232", "V peat"), "L": ("#d6a35c", "L loam"),
           "G": ("#d7655a", "G gravel"), "SHE": ("#7fb6d6", "SHE shells"), "GM": ("#dddddd", "GM no sample"),
           "NBE": ("#a98fc7", "NBE not named")}
STRATA = ("#e9c46a", "#8ab17d", "#b5838d", "#577590", "#f4a261", "#6d9dc5", "#cdb4db", "#f2e8cf", "#d62839", "#555b6e")


class Bench:
    """Runs regionmesh in a folder of its own, its Delaunay program under a watch."""

    def __init__(self, arguments):
        self.temporary = tempfile.TemporaryDirectory(dir=arguments.folder)
        self.folder, self.data = pathlib.Path(self.temporary.name), pathlib.Path(arguments.data or "")
        programs = pathlib.Path(arguments.program).parent
        shutil.copy(programs / "regionmesh", self.folder)
        shutil.copy(programs / "regionmesh-delaunay", self.folder / "watched")
        watch = self.folder / "regionmesh-delaunay"
        watch.write_text(f"#!/bin/sh\nexec /usr/bin/time -q -f '%M %e' -o {self.at('watch')} {self.at('watched')} \"$@\"\n")
        watch.chmod(0o755)
        self.points = {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.temporary.cleanup()

    def at(self, name):
        return self.folder / name

    def table(self, name):
        found = sorted(self.data.rglob(name))
        if not found:
            raise SystemExit(f"{name} is not in the folder that --data names")
        return found[0]

    def run(self, *words):
        return subprocess.run([self.at("regionmesh"), *map(str, words)], capture_output=True, text=True)

    def reconstruct(self, source, *options, model="model.vtp"):
        """What the report says, the seconds of the whole, and the peak of the Delaunay program."""
        start = time.monotonic()
        done = self.run("reconstruct", *source, *options, "-o", self.at(model), "--report", self.at("report.json"), "--quiet")
        seconds = time.monotonic() - start
        if done.returncode:
            raise SystemExit(f"{source} {options}: exit {done.returncode}: {done.stderr.strip()}")
        kilobytes, delaunay = self.at("watch").read_text().split()[-2:]
        return json.loads(self.at("report.json").read_text()) | {
            "whole": seconds, "delaunay_bytes": 1024 * int(kilobytes), "delaunay_seconds": float(delaunay)}

    def source(self, site):
        return [self.table(SITES[site]["file"]), "--columns", ",".join(SITES[site]["columns"].words())]

    def logged(self, site):
        return holes.read(self.table(SITES[site]["file"]), SITES[site]["columns"])

    def agreement(self, site, model="model.vtp"):
        """Shares of the length of all holes that lies in the region that was logged there, and outside of all."""
        places, words, lengths = holes.samples(*self.logged(site), SITES[site]["probe"])
        names = picture.names_of(picture.draw.read(self.at(model)))
        found = [names.get(label) for label in holes.labels_at(self.at(model), places)]
        good, outside = (numpy.array([test(a, b) for a, b in zip(found, words)])
                         for test in (lambda a, b: a == b, lambda a, b: a is None))
        return {"agreement": float(lengths[good].sum() / lengths.sum()), "outside": float(lengths[outside].sum() / lengths.sum())}

    def scattered(self, world):
        """The table of a synthetic world, made when it is first asked for."""
        if world not in self.points:
            self.points[world] = getattr(synthetic, world)(COUNT)
            synthetic.write(self.at(f"{world}.csv"), *self.points[world])
        return [self.at(f"{world}.csv")]

    def agreement_of_points(self, world, model="model.vtp"):
        points, labels = (array[-PROBES:] for array in self.points[world])  # none of those on the sides of a box
        found = holes.labels_at(self.at(model), points)
        return {"agreement": float(numpy.mean([a == b for a, b in zip(found, labels.tolist())]))}


def kept(report):
    smoothing = report["smoothing"]
    return {key: report[key] for key in ("initial_faces", "final_faces", "region_pairs", "quadruple_points_inside", "peak_bytes",
                                         "delaunay_bytes", "delaunay_seconds", "whole", "stopped", "seconds")} | {
        "regions": len(report["regions"]), "violations": sum(report["violation_counts"].values()),
        "least_quality": report["quality"]["min"], "mean_quality": report["quality"]["mean"],
        "guard_seconds": smoothing["guard_seconds"], "filter_seconds": smoothing["filter_seconds"]}


def case(bench, source, reading, options):
    """A row of the table of models; it is checked against the labels once more."""
    sized = re.search(r"(\d+) points, (\d+) tetrahedra", bench.run("info", *source, *reading).stdout)
    reports = [bench.reconstruct(source, *reading, *options) for _ in range(ROUNDS)]
    checked = bench.run("check", bench.at("model.vtp"), "--sections", *source, *reading, "--quiet")
    return kept(reports[0]) | {
        "points": int(sized[1]), "tetrahedra": int(sized[2]), "check": checked.returncode,
        "whole": statistics.median(report["whole"] for report in reports),
        "peak_bytes": max(report["peak_bytes"] for report in reports),
        "delaunay_bytes": max(report["delaunay_bytes"] for report in reports)}


def readings(site):
    """How a site is read, in steps and with one point an interval."""
    given = SITES[site]
    return {"steps": ("--step", given["step"], "--scale-z", given["scale"]), "middles": ("--scale-z", given["scale_middle"])}


def sites(bench):
    return {f"{site} {how}": case(bench, bench.source(site), reading, ("--reduce", DRAWN)) | bench.agreement(site)
            for site in SITES for how, reading in readings(site).items()}


def worlds(bench):
    return {f"{world} {passes}": case(bench, bench.scattered(world), (), ("--reduce", "90%", "--smooth", passes)) |
            bench.agreement_of_points(world) for world, passes in
            (("strata", 0), ("strata", 20), ("boxed_strata", 20), ("grains", 0), ("grains", 20))}


def spacing(bench):
    results = {}
    for site in SITES:
        rows, _ = bench.logged(site)
        results[site] = {"holes": len(holes.shafts(rows)), "distance": float(holes.distances(rows).mean()),
                         "thickness": float((rows[:, 2] - rows[:, 3]).mean()), "steps": readings(site)["steps"][1::2],
                         "middles": readings(site)["middles"][1]}
    return results


def choices(bench):
    """Kim's wells, one option changed at a time."""
    source, given, rows = bench.source("kim"), SITES["kim"], {}
    usual = ("--step", given["step"], "--scale-z", given["scale"])
    trials = {"step": [("--step", step, "--scale-z", f"{given['scale'] * given['step'] / step:.3g}") for step in (200, 100, 50)],
              "scale": [("--step", given["step"], "--scale-z", f"{given['scale'] * f:.3g}") for f in (1 / given["scale"], 0.1, 0.3, 3, 10)],
              "reduce": [(*usual, "--reduce", share) for share in ("50%", "70%", "80%", "90%")],
              "smooth": [(*usual, "--smooth", passes) for passes in (20, 100)]}
    for kind, all_words in {"none": [("--scale-z", given["scale_middle"]), usual], **trials}.items():
        for words in all_words:
            options = words if "--smooth" in words else (*words, "--smooth", "0")
            options = options if "--reduce" in options else (*options, "--no-decimate")
            if kind == "scale":
                reduced = bench.reconstruct(source, *words, "--smooth", "0", "--reduce", "90%")["final_faces"]
            report = kept(bench.reconstruct(source, *options)) | bench.agreement("kim")
            rows[" ".join(map(str, words))] = report | ({"reduced": reduced} if kind == "scale" else {})
    return rows


def digest(path):
    return hashlib.md5(path.read_bytes()).hexdigest()


def memory(bench):
    """The strata within several budgets, and on one thread and two."""
    source, options = bench.scattered("strata"), ("--reduce", "90%", "--smooth", "0")
    said = bench.run("reconstruct", *source, *options, "--memory", "1MB", "-o", bench.at("model.vtp")).stderr
    least = re.search(r"at least (\d+ [kMG]?B)", said)[1].replace(" ", "")
    rows, digests = {}, {}
    for budget in ("2GiB", "200MB", "100MB", least):
        rows[budget] = kept(bench.reconstruct(source, *options, "--memory", budget))
    for threads in (1, 2):
        bench.reconstruct(source, *options, "--threads", threads)
        digests[threads] = digest(bench.at("model.vtp"))
    bench.reconstruct(source, "--reduce", "90%", "--threads", 1)
    smoothed = digest(bench.at("model.vtp"))
    bench.reconstruct(source, "--reduce", "90%", "--threads", 2)
    return {"rows": rows, "said": said.strip().replace(f"{bench.folder}/", ""),
            "same_bytes": digests[1] == digests[2] and smoothed == digest(bench.at("model.vtp"))}


def machine(_):
    with open("/proc/cpuinfo") as file:
        name = next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    return f"{len(os.sched_getaffinity(0))} cores of an {name}"


PARTS = {"machine": machine, "spacing": spacing, "choices": choices, "sites": sites, "worlds": worlds, "memory": memory}


def rgb(code):
    return tuple(int(code[n:n + 2], 16) / 255 for n in (1, 3, 5))


def panel(bench, site, options, colours, shafts, **scene):
    bench.reconstruct(bench.source(site), *options)
    names = picture.names_of(picture.draw.read(bench.at("model.vtp")))
    scene = picture.Scene({label: rgb(colours[name]) for label, name in names.items()}, **scene)
    return picture.actors_of(bench.at("model.vtp"), scene, shafts)


def draw_all(bench, folder):
    given = {site: readings(site) for site in SITES}
    shafts = {site: holes.shafts(bench.logged(site)[0]) for site in SITES}
    entries = [(rgb(code), name) for name, code in KIM.items()]
    cut_open = {"exaggeration": 8, "turn": 195}
    picture.sheet(folder / "boreholes-kim.png", [
        (text, panel(bench, "kim", (*given["kim"][how], "--reduce", DRAWN), KIM, shafts["kim"], **cut_open))
        for how, text in (("middles", "one point an interval"), ("steps", "--step 25"))], entries, (610, 520), (1.35, 1.35))

    panels, above = [], list(KIM)[:list(KIM).index("vedder")]
    for text, options in (("all faces", ["--no-decimate"]), ("--reduce 70%", ["--reduce", "70%"])):
        bench.reconstruct(bench.source("kim"), "--step", 100, "--scale-z", 22, *options)
        colours = {label: rgb(KIM[name]) for label, name in picture.names_of(picture.draw.read(bench.at("model.vtp"))).items()}
        panels.append((text, picture.boundary_actors(bench.at("model.vtp"), picture.Scene(colours, 8, 195), above)))
    picture.sheet(folder / "boreholes-decimated.png", panels, entries[:len(above)], (610, 440), (2.9, 2.9))

    colours = {name: code for name, (code, _) in UTRECHT.items()}
    options = (*given["utrecht"]["steps"], "--reduce", DRAWN)
    picture.sheet(folder / "boreholes-utrecht.png", [
        ("all, heights 4 times", panel(bench, "utrecht", options, colours, shafts["utrecht"], exaggeration=4, turn=180)),
        ("above -6 m, heights 60 times",
         panel(bench, "utrecht", options, colours, shafts["utrecht"], exaggeration=60, turn=0, floor=-6))],
        [(rgb(code), text) for code, text in UTRECHT.values()], (610, 520), (1.15, 1.15))

    panels = []
    for world, text in (("strata", "points at random"), ("boxed_strata", "a tenth of them on the sides of the box")):
        bench.reconstruct(bench.scattered(world), "--reduce", "90%")
        scene = picture.Scene({n + 1: rgb(code) for n, code in enumerate(STRATA)}, turn=160, cut=(0.5, 0.58))  # through a lens
        panels.append((text, picture.actors_of(bench.at("model.vtp"), scene)))
    words = [f"layer {n}" for n in range(1, 9)] + ["lens", "intrusion"]
    picture.sheet(folder / "boreholes-strata.png", panels, list(zip(map(rgb, STRATA), words)), (610, 440), (1.5, 1.5))
