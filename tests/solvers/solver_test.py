#!/usr/bin/python3
"""A volume all the way to a tension test: solver_test.py PROGRAM VOLUME FOLDER

The model, smoothed and at a tenth of its faces, must be meshed by TetGen and by Gmsh without complaint, every region
with its volume; and CalculiX must find the right reaction on the tetrahedra, with a material of its own in each region.
"""
import os
import sys

from solver_run import Mesh, expect, report_volumes, require, run, tetgen_volumes
from tension import Tension

TOLERANCE = 1e-9  # of volumes


def check_volumes(solver, found, expected):
    expect(set(found) == set(expected), f"{solver} returns {len(found)} of {len(expected)} regions")
    worst = max(abs(found[label] / expected[label] - 1) for label in expected)
    expect(worst < TOLERANCE, f"{solver}: volumes differ by {worst:.1e} at most")


def check_groups(mesh, smesh):
    """Each interface of the model is a set of elements, and so is each region."""
    with open(smesh) as file:
        pairs = [line.split()[3:] for line in file if line.startswith("# interface ")]
    names = {f"interface_{a}_{'exterior' if b == '-1' else b}" for a, b in pairs}
    missing = [name for name in names if not mesh.element_sets.get(name)]
    expect(not missing, f"gmsh keeps {len(names) - len(missing)} of {len(names)} interfaces")


def check_tension(mesh, expected):
    """With equal Poisson's ratios the reaction lies between the bounds of Reuss and Voigt, for any mesh; materials that
    differ by a tenth bring these within 1 % of one another."""
    moduli = {label: 100 + 10 * (n % 3) for n, label in enumerate(expected)}
    tension = Tension(mesh, axis=2, poisson=0.3)
    reaction = tension.reaction({f"region_{label}": modulus for label, modulus in moduli.items()})
    total = sum(expected.values())
    shares = {label: volume / total for label, volume in expected.items()}
    voigt = sum(share * moduli[label] for label, share in shares.items()) * tension.force_per_modulus
    reuss = tension.force_per_modulus / sum(share / moduli[label] for label, share in shares.items())
    expect(voigt / reuss < 1.01, f"the bounds are {100 * (voigt / reuss - 1):.2f} % apart")
    rounding = 1e-5  # the solver prints seven digits
    expect(reuss * (1 - rounding) <= reaction <= voigt * (1 + rounding),
           f"ccx: reaction {reaction:.6g} between {reuss:.6g} and {voigt:.6g}")


def main():
    program, volume, folder = sys.argv[1:]
    require("tetgen", "gmsh", "ccx")
    program, volume = os.path.abspath(program), os.path.abspath(volume)
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    for output in ("model.smesh", "model.msh"):
        run(program, "reconstruct", volume, "--no-background", "--reduce", "90%", "-o", output, "--report",
            "report.json", "--quiet")
    expected = report_volumes("report.json")

    run("tetgen", "-pqO2/3A", "model.smesh")  # no vertices are added at the end: some would lie beside the faces
    check_volumes("tetgen", tetgen_volumes("model", "model.smesh"), expected)

    run("gmsh", "-3", "model.geo", "-setnumber", "Mesh.SaveGroupsOfNodes", "1", "-o", "mesh.inp")
    mesh = Mesh("mesh.inp")
    found = {name[len("region_"):]: mesh.volume_of(name) for name in mesh.element_sets if name.startswith("region_")}
    check_volumes("gmsh", found, expected)
    check_groups(mesh, "model.smesh")
    check_tension(mesh, expected)


main()
