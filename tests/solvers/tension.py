"""A tension test of a box of tetrahedra for CalculiX."""
import os

from solver_run import run

SIDES = ("XMIN", "XMAX", "YMIN", "YMAX", "ZMIN", "ZMAX")
STRAIN = 1e-3


class Tension:
    """The box is pulled along an axis; its three lower sides keep their planes, so that it may contract freely."""

    def __init__(self, mesh, axis, poisson):
        self.mesh, self.axis, self.poisson = mesh, axis, poisson
        sizes = [self.plane(2 * a + 1) - self.plane(2 * a) for a in range(3)]
        self.area = sizes[0] * sizes[1] * sizes[2] / sizes[axis]
        self.displacement = STRAIN * sizes[axis]
        self.force_per_modulus = STRAIN * self.area

    def plane(self, side):
        return self.mesh.nodes[self.mesh.node_sets[SIDES[side]][0]][side // 2]

    def reaction(self, moduli):
        """The force on the upper side, with the modulus given for each region."""
        pulled = SIDES[2 * self.axis + 1]
        with open("tension.inp", "w") as deck:
            self.write_mesh(deck, moduli)
            for name, modulus in moduli.items():
                deck.write(f"*MATERIAL, NAME={name}\n*ELASTIC\n{modulus}, {self.poisson}\n"
                           f"*SOLID SECTION, ELSET={name}, MATERIAL={name}\n")
            deck.write("*STEP\n*STATIC\n*BOUNDARY\n")
            for axis in range(3):
                deck.write(f"{SIDES[2 * axis]}, {axis + 1}, {axis + 1}\n")
            deck.write(f"{pulled}, {self.axis + 1}, {self.axis + 1}, {self.displacement!r}\n"
                       f"*NODE PRINT, NSET={pulled}, TOTALS=ONLY\nRF\n*END STEP\n")
        if os.path.exists("tension.dat"):
            os.remove("tension.dat")
        run("ccx", "tension")
        with open("tension.dat") as result:
            lines = [line.split() for line in result if line.strip()]
        return float(lines[-1][self.axis])

    def write_mesh(self, deck, regions):
        deck.write("*NODE, NSET=ALL\n")
        for number, (x, y, z) in self.mesh.nodes.items():
            deck.write(f"{number}, {x:.12g}, {y:.12g}, {z:.12g}\n")
        for name in regions:
            deck.write(f"*ELEMENT, TYPE=C3D4, ELSET={name}\n")
            for element in self.mesh.element_sets[name]:
                deck.write(", ".join([element, *self.mesh.tetrahedra[element]]) + "\n")
        for name in SIDES:
            deck.write(f"*NSET, NSET={name}\n")
            for node in self.mesh.node_sets[name]:
                deck.write(f"{node},\n")
