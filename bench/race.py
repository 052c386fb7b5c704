"""Programs measured in turn: regionmesh and its peers on one case, round after round, so that other work on the computer
hits all of them alike."""
import dataclasses
import json
import os
import statistics
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
VIOLATIONS = 3   # exit code of regionmesh
CANNOT_READ = 3  # exit code of vtk_pair.py and surface_nets.cpp
PEERS = {"meshoptimizer": "meshoptimizer", "tetrahedra": "meshoptimizer, tetrahedra", "VTK": "VTK", "SurfaceNets": "SurfaceNets"}
COMPILED = {"meshoptimizer": "meshoptimizer", "tetrahedra": "meshoptimizer", "SurfaceNets": "surface_nets"}  # peers/NAME.cpp
SAMPLES = 200_000  # points on each surface from which distances are taken


class Absent(Exception):
    """Why a peer has no figures: told in its row, and no failure of the benchmark."""


@dataclasses.dataclass
class Result:
    seconds: float
    initial_faces: int
    final_faces: int
    peak_bytes: int
    report: dict


@dataclasses.dataclass
class Lane:
    """One program, or one way to call it, and what it gave on a case."""
    name: str
    measure: object  # called without arguments once a round: Result, or raises Absent
    is_ours: bool = False
    results: list = dataclasses.field(default_factory=list)
    absent: str = ""
    rms: float | None = None

    def faces(self):
        return self.results[0].initial_faces

    def median(self, value):
        return statistics.median(value(result) for result in self.results)

    def middle(self):
        """The run with the median of the seconds."""
        return sorted(self.results, key=lambda result: result.seconds)[len(self.results) // 2]


@dataclasses.dataclass
class Setting:
    """How programs are called."""
    program: str
    folder: str
    reduce: float = 0.9
    target_faces: int = 0  # instead of a share, where given
    smooth: int = 0
    threads: int = 0  # 0: as many as there are
    options: tuple = ()
    limit: float = 120  # seconds that one run of a peer may take
    model: str = "model.vtp"

    def but(self, **changes):
        return dataclasses.replace(self, **changes)

    def at(self, name):
        return os.path.join(self.folder, name)


def race(lanes, rounds):
    """Runs all lanes in each round, backward in every second one, and in the order given in the first."""
    for n in range(rounds):
        for lane in lanes if n % 2 == 0 else lanes[::-1]:
            if lane.absent:
                continue
            try:
                lane.results.append(lane.measure())
            except Absent as why:
                lane.absent, lane.results = str(why), []
    return lanes


def ratios(a, b):
    """Of the seconds of one lane to those of another, round by round."""
    return [of_a.seconds / of_b.seconds for of_a, of_b in zip(a.results, b.results)]


def run(command, fine=(0,)):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in fine:
        sys.exit(f"{' '.join(command)}: exit {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def common(setting):
    threads = ["--threads", str(setting.threads)] if setting.threads else []
    return ["--smooth", str(setting.smooth), "--quiet", *threads, *setting.options]


def ours(case, setting):
    """From labels to the model written and checked: the wall time of the whole process."""
    report = setting.at("report.json")
    goal = ["--target-faces", str(setting.target_faces)] if setting.target_faces else ["--reduce", f"{100 * setting.reduce:g}%"]
    command = [setting.program, "reconstruct", case.path, "-o", setting.at(setting.model), *goal, "--report", report, *common(setting)]
    start = time.perf_counter()
    run(command)
    seconds = time.perf_counter() - start
    with open(report) as file:
        report = json.load(file)
    return Result(seconds, report["initial_faces"], report["final_faces"], report["peak_bytes"], report)


def write_full(case, setting):
    """The unsimplified model as full.ply, smoothed or not as the simplified one is."""
    run([setting.program, "reconstruct", case.path, "-o", setting.at("full.ply"), "--no-decimate", *common(setting)])


def write_tetrahedra(case, setting):
    """That of the same samples with --cells tetrahedra, as tetrahedra.ply."""
    write = setting.but(options=(*setting.options, "--cells", "tetrahedra"))
    run([write.program, "reconstruct", case.path, "-o", write.at("tetrahedra.ply"), "--no-decimate", *common(write)])


def peer(command, setting):
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=setting.limit)
    except subprocess.TimeoutExpired:
        raise Absent(f"over {setting.limit:g} s") from None
    if done.returncode == CANNOT_READ:
        raise Absent("does not read this file")
    if done.returncode:
        raise Absent(f"failed: {(done.stderr.strip().splitlines() or [f'exit {done.returncode}'])[-1]}")
    report = json.loads(done.stdout)
    if report["initial_faces"] == 0:
        raise Absent("finds no faces")
    return Result(report["seconds"], report["initial_faces"], report["final_faces"], report["peak_bytes"], report)


def distance(setting, a, b):
    """Root of the mean squared distance between the surfaces of two files, both ways."""
    path = setting.at("compare.json")
    run([setting.program, "compare", setting.at(a), setting.at(b), "--no-background", "--samples", str(SAMPLES), "--json", path,
         "--quiet"])
    with open(path) as file:
        return json.load(file)["distance"]["both"]["rms"]


def checked(case, setting):
    """The model checked anew, with its samples: the wall time of the whole process."""
    command = [setting.program, "check", setting.at(setting.model), "--sections", case.path, "--quiet",
               *(["--no-background"] if "--no-background" in setting.options else [])]
    start = time.perf_counter()
    run(command, fine=(0, VIOLATIONS))
    return time.perf_counter() - start


def crossing_count(setting):
    """Pairs of faces that cross in the model."""
    path = setting.at("check.json")
    run([setting.program, "check", setting.at(setting.model), "--json", path, "--quiet"], fine=(0, VIOLATIONS))
    with open(path) as file:
        return json.load(file)["violation_counts"]["crossing_faces"]


class Peers:
    """Which are installed, and how to call them."""

    def __init__(self, names, folder):
        self.names = [name for name in PEERS if name in names]
        self.versions = {}
        self.missing = set()
        self.folder = folder
        self.missing |= {name for name in self.names if name in COMPILED and not self.compile(COMPILED[name])}
        if "VTK" in self.names and not succeeds([sys.executable, "-c", "import vtkmodules.vtkFiltersGeneral"]):
            self.missing.add("VTK")

    def compile(self, program):
        compiler = os.environ.get("CXX", "c++")
        if not succeeds([compiler, "-E", "-x", "c++", "-include", "meshoptimizer.h", os.devnull]):
            return False
        run([compiler, "-std=c++20", "-O3", "-DNDEBUG", os.path.join(HERE, f"peers/{program}.cpp"), "-lmeshoptimizer",
             "-o", os.path.join(self.folder, program)])
        return True

    def lanes(self, case, setting, our_lane, is_measured):
        """Of each peer. What it makes is kept for distances where those are measured."""
        def kept(name):
            return [setting.at(name)] if is_measured else []

        def simplified(full, result):
            target = our_lane.results[0].final_faces
            return [os.path.join(self.folder, "meshoptimizer"), setting.at(full), str(target), *kept(result)]

        commands = {
            "meshoptimizer": lambda: simplified("full.ply", "meshoptimizer.ply"),
            "tetrahedra": lambda: simplified("tetrahedra.ply", "tetrahedra-reduced.ply"),
            "VTK": lambda: [sys.executable, os.path.join(HERE, "peers/vtk_pair.py"), case.path, f"{setting.reduce:g}", *kept("vtk")],
            "SurfaceNets": lambda: [os.path.join(self.folder, "surface_nets"), case.path, str(our_lane.results[0].final_faces),
                                    *kept("nets")]}
        return [Lane(PEERS[name], lambda name=name: self.call(name, commands[name](), setting)) for name in self.names]

    def call(self, name, command, setting):
        if name in self.missing:
            raise Absent("not installed")
        result = peer(command, setting)
        self.versions[name] = result.report["version"]
        return result


def measure_distances(lanes, setting):
    files = {"meshoptimizer": ("full.ply", "meshoptimizer.ply"), "VTK": ("vtk-full.ply", "vtk-reduced.ply"),
             "meshoptimizer, tetrahedra": ("tetrahedra.ply", "tetrahedra-reduced.ply"),
             "SurfaceNets": ("nets-full.ply", "nets-reduced.ply")}
    for lane in lanes:
        if lane.results and lane.results[0].final_faces > 0:
            lane.rms = distance(setting, *(("full.ply", "model.vtp") if lane.is_ours else files[lane.name]))


def succeeds(command):
    try:
        return subprocess.run(command, capture_output=True).returncode == 0
    except OSError:
        return False
