#!/usr/bin/python3
"""Layers of very different stiffness: laminate_test.py PROGRAM FOLDER

Pulled across the layers and along them, CalculiX must find the reactions that mechanics of materials gives exactly.
"""
import os
import sys

from solver_run import Mesh, expect, report_volumes, require, run
from tension import Tension

SIZE = 13
LAYERS = {1: range(0, 4), 2: range(4, 9), 3: range(9, SIZE)}
MODULI = {1: 1.0, 2: 10.0, 3: 200.0}


def write_volume(path):
    label_of = {z: label for label, layer in LAYERS.items() for z in layer}
    with open(path, "wb") as file:
        for z in range(SIZE):
            file.write(bytes([label_of[z]]) * SIZE * SIZE)


def expect_reaction(direction, found, right):
    expect(abs(found / right - 1) < 1e-5, f"ccx: reaction {direction} the layers {found:.6g}, {right:.6g} is right")


def main():
    program, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    require("gmsh", "ccx")
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    write_volume("laminate.raw")
    run(program, "reconstruct", "laminate.raw", "--size", f"{SIZE},{SIZE},{SIZE}", "--type", "uint8", "--reduce", "90%",
        "-o", "laminate.msh", "--report", "report.json", "--quiet")
    run("gmsh", "-3", "laminate.geo", "-setnumber", "Mesh.SaveGroupsOfNodes", "1", "-o", "mesh.inp")
    mesh = Mesh("mesh.inp")
    volumes = report_volumes("report.json")
    shares = {label: volumes[str(label)] / sum(volumes.values()) for label in LAYERS}
    moduli = {f"region_{label}": modulus for label, modulus in MODULI.items()}

    # Without lateral contraction the stress across the layers is the same in all of them.
    across = Tension(mesh, axis=2, poisson=0.0)
    expect_reaction("across", across.reaction(moduli),
                    across.force_per_modulus / sum(shares[label] / MODULI[label] for label in LAYERS))
    along = Tension(mesh, axis=0, poisson=0.3)
    expect_reaction("along", along.reaction(moduli),
                    along.force_per_modulus * sum(shares[label] * MODULI[label] for label in LAYERS))


main()
