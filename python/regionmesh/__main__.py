"""The program: `python -m regionmesh reconstruct labels.nii.gz -o model.vtp`."""

import os
import sys

from ._programs import path_of


def main():
    """Replace this process by the program, with the same arguments."""
    program = path_of("regionmesh")
    if program is None:
        sys.exit("regionmesh: the program is not beside the module; install the package again")
    os.execv(program, ["regionmesh", *sys.argv[1:]])


if __name__ == "__main__":
    main()
