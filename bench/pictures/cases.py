"""Runs regionmesh for the pictures: each model once, with its report and the processor time of the run."""
import json
import pathlib
import resource
import sys

import shade
import draw
import lead
import numpy
import presets
import rough
from lab import Lab

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "boreholes"))
import measure as boreholes  # noqa: E402: Kim's wells and their colours
import picture  # noqa: E402

KEPT = ("final_faces", "initial_faces", "samples_wrong", "samples", "samples_in_room", "stopped", "dice")
REDUCTIONS, ROOMS = (90, 95, 99), (0, 1, 2)
APART = 5  # of the mouse's sections, in samples
CROP = numpy.s_[16:112, 80:176, 80:176]  # of the head


class Bench(Lab):
    def case(self, name, source, *options):
        """Figures of a model, made unless it is there. Models stay in the folder as NAME.vtp."""
        report, cost = self.at(f"{name}.json"), self.at(f"{name}.seconds")
        if not cost.exists():
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            self.run("reconstruct", *source, *options, "-o", self.model(name), "--report", report, "--quiet")
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            cost.write_text(f"{after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime:.2f}\n")
        read = json.loads(report.read_text())
        return {key: read.get(key) for key in KEPT} | {
            "seconds": float(cost.read_text()), "violations": sum(read["violation_counts"].values()),
            "quality": read["quality"]["mean"], "lowest": read["quality"]["min"], "turning": read["triple_lines"].get("mean_turning_angle")}

    def model(self, name):
        return self.at(f"{name}.vtp")

    def derived(self, name, make):
        """A volume made from another."""
        path = self.at(name)
        if not path.exists():
            numpy.save(path, numpy.ascontiguousarray(make()))
        return path

    def mouse(self):
        import scipy.io
        return self.derived("mouse5.npy", lambda: scipy.io.loadmat(self.volume("digimouse.mat"))["digimouse"][:, ::APART, :])

    def head(self):
        return self.derived("head96.npy", lambda: numpy.load(self.volume("zubal_head.npy"))[CROP])

    def source(self, model):
        if model == "wells":
            site = boreholes.SITES["kim"]
            return [self.volume(site["file"]), "--columns", ",".join(site["columns"].words()), "--step", site["step"],
                    "--scale-z", site["scale"]]
        return {"brain": lambda: [self.volume("aal.nii.gz"), "--reduce", "90%"],
                "grains": lambda: [self.volume("in100_60x80x100.npy")],
                "mouse": lambda: [self.mouse(), "--spacing", f"1,{APART},1"]}[model]()


def wells(path):
    names = picture.names_of(draw.read(path))
    colours = {label: boreholes.rgb(boreholes.KIM[name]) for label, name in names.items()}
    return picture.actors_of(path, picture.Scene(colours, exaggeration=8, turn=195))


def presets_of(bench, model):
    results = {preset: bench.case(f"{model}_{preset}", bench.source(model), "--smooth", preset) for preset in presets.PRESETS}
    shared = {"wells": wells}
    presets.sheet([(f"--smooth {preset}", presets.PANELS[model](bench.model(f"{model}_{preset}"), shared))
                   for preset in presets.PRESETS], bench.pictures / f"presets-{model}.png", presets.TILES[model])
    return results


def rooms(bench):
    shared = {}
    names = {room: "brain_normal" if room == 0 else f"brain_room{room}" for room in ROOMS}
    results = {room: bench.case(name, bench.source("brain"), "--room", room) for room, name in names.items()}
    for room, name in names.items():
        results[room]["area"] = float(shade.pairs_of(draw.read(bench.model(name)))[1].sum())
    presets.sheet([(f"--room {room}", presets.brain_panel(bench.model(name), shared)) for room, name in names.items()],
                  bench.pictures / "room.png", presets.TILES["room"], columns=3)
    return results


def kept_samples(bench):
    sources = {"aal96": bench.volume("aal96.npy"), "in100": bench.volume("in100_60x80x100.npy"), "head96": bench.head()}
    return {f"{name} {share} {word}": bench.case(f"{name}_{word}_{share}", [source], "--reduce", f"{share}%", *options)
            for name, source in sources.items() for share in REDUCTIONS
            for word, options in (("keep", ()), ("nokeep", ("--no-keep-samples",)))}


def measure(bench, part):
    if part == "lead":
        result = bench.case("brain_normal", bench.source("brain"), "--smooth", "normal")
        lead.make(bench.model("brain_normal"), bench.pictures / "aal.png")
        return result
    if part == "rough":
        return rough.make(bench, bench.pictures / "rough.png")
    return rooms(bench) if part == "room" else kept_samples(bench) if part == "samples" else presets_of(bench, part)
