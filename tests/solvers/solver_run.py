"""What the solver tests share: running programs, and reading what they write. Standard library only."""
import json
import os
import shutil
import subprocess
import sys

SKIPPED = 77  # ctest shows this as skipped


def require(*programs):
    """Ends the test as skipped where a program is missing; as failed where REGIONMESH_REQUIRE_SOLVERS is set."""
    missing = [program for program in programs if not shutil.which(program)]
    if not missing:
        return
    print("missing:", ", ".join(missing), "(script/bootstrap solvers)")
    sys.exit(1 if os.environ.get("REGIONMESH_REQUIRE_SOLVERS") else SKIPPED)


def run(*command):
    """Runs a program and returns what it said; a failure or a word of errors ends the test."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    complaints = [line for line in done.stdout.splitlines()
                  if any(word in line for word in ("Error", "*ERROR", "error:")) and " 0 errors" not in line]
    if done.returncode != 0 or complaints:
        print(done.stdout[-4000:])
        sys.exit(f"failed: {' '.join(map(str, command))}\n" + "\n".join(complaints[:5]))
    return done.stdout


def expect(holds, text):
    print("ok  " if holds else "FAIL", text)
    if not holds:
        sys.exit(1)


def volume(a, b, c, d):
    u, v, w = ([q - p for p, q in zip(a, x)] for x in (b, c, d))
    return abs(u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
               u[2] * (v[0] * w[1] - v[1] * w[0])) / 6


def rows(path):
    """The lines of a TetGen file as words, without comments and the first, which counts them."""
    with open(path) as file:
        lines = (line.split("#")[0].split() for line in file)
        return [words for words in lines if words][1:]


def report_volumes(path):
    """Volume by label, of the report that regionmesh wrote."""
    with open(path) as file:
        return {str(region["label"]): region["volume"] for region in json.load(file)["regions"]}


def tetgen_volumes(base, smesh):
    """Volume by label of the tetrahedra in base.1.ele, by the table at the head of the .smesh."""
    labels = {}
    with open(smesh) as file:
        for line in file:
            if line.startswith("# region "):
                _, _, attribute, label, _ = line.split()
                labels[attribute] = label
    nodes = {row[0]: tuple(map(float, row[1:4])) for row in rows(f"{base}.1.node")}
    sums = {}
    for row in rows(f"{base}.1.ele"):
        label = labels[row[5]]
        sums[label] = sums.get(label, 0) + volume(*(nodes[v] for v in row[1:5]))
    return sums


class Mesh:
    """An Abaqus file as Gmsh writes it."""

    def __init__(self, path):
        self.nodes, self.tetrahedra, self.element_sets, self.node_sets = {}, {}, {}, {}
        add = None
        with open(path) as file:
            for line in file:
                if line.startswith("*"):
                    add = self.reader_for(line.strip())
                elif add:
                    add([word.strip() for word in line.split(",") if word.strip()])

    def reader_for(self, keyword):
        words = [word.strip() for word in keyword.split(",")]
        kind, options = words[0].upper(), dict(word.split("=") for word in words[1:])
        if kind == "*NODE":
            return lambda row: self.nodes.__setitem__(row[0], tuple(map(float, row[1:])))
        if kind == "*ELEMENT" and options["type"] == "C3D4":
            return lambda row: self.tetrahedra.__setitem__(row[0], row[1:])
        if kind == "*ELSET":
            return self.element_sets.setdefault(options["ELSET"], []).extend
        if kind == "*NSET":
            return self.node_sets.setdefault(options["NSET"], []).extend
        return None

    def volume_of(self, element_set):
        return sum(volume(*(self.nodes[v] for v in self.tetrahedra[e])) for e in self.element_sets[element_set])
