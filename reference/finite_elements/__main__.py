"""Command line: compute the histories, compare them with the stored ones, check the program on known answers."""

import argparse
import sys
from pathlib import Path

from . import compare, histories, known_answers
from .plates import PLATES

ORDERED = ("coarse", "standard", "fine")


def parser():
    """The commands and their options."""
    root = argparse.ArgumentParser(prog="finite_elements", description=__doc__)
    commands = root.add_subparsers(dest="command", required=True)

    run = commands.add_parser("run", help="compute histories of K and write them as CSV")
    run.add_argument("plates", nargs="*", metavar="plate", help=f"any of {', '.join(PLATES)}; all when left out")
    run.add_argument("--mesh", choices=ORDERED, default="standard", help="(default: standard)")
    run.add_argument("--output", type=Path, default=Path("output"), help="folder for the files (default: output)")

    check = commands.add_parser("compare", help="compare computed histories with stored ones; exit 1 beyond 0.5 %%")
    check.add_argument("plates", nargs="*", metavar="plate", help=f"any of {', '.join(PLATES)}; all when left out")
    check.add_argument("--stored", type=Path, default=Path(__file__).resolve().parents[1] / "data/finite_elements",
                       help="folder of the stored files (default: reference/data/finite_elements)")
    check.add_argument("--computed", type=Path, default=Path("output"),
                       help="folder of the computed files (default: output)")

    verify = commands.add_parser("verify", help="cracks at rest and Freund's suddenly loaded crack; exit 1 on a miss")
    verify.add_argument("--mesh", choices=ORDERED, default="standard", help="(default: standard)")
    return root


def chosen(names):
    """The plates of these names, all for none."""
    unknown = [name for name in names if name not in PLATES]
    if unknown:
        raise ValueError(f"no plate is called {', '.join(unknown)}: take one of {', '.join(PLATES)}")
    return [PLATES[name]() for name in names or PLATES]


def run(options):
    """Write one file per plate."""
    plates = chosen(options.plates)
    options.output.mkdir(parents=True, exist_ok=True)
    for plate in plates:
        rows = histories.table(plate, options.mesh, tell=lambda line: print(line, flush=True))
        histories.write(options.output / plate.file, plate, rows)
        print(f"wrote {options.output / plate.file}", flush=True)
    return 0


def compared(options):
    """Print one line per history."""
    found = []
    print("differences in % of the peak: largest and rms of all rows, largest and rms away from fronts")
    for plate in chosen(options.plates):
        tables = [compare.read(folder / plate.file, plate.header) for folder in (options.stored, options.computed)]
        lines = compare.differences(plate, *tables)
        print(plate.file, *lines, sep="\n")
        found += lines
    return 0 if all(line.holds for line in found) else 1


def verified(options):
    """Print one line per known answer."""
    holds = True
    for answer in known_answers.answers(options.mesh):
        print(answer, flush=True)
        holds = holds and answer.holds
    return 0 if holds else 1


def main(arguments=None):
    """Exit code: 0 done and within bounds, 1 beyond them, 2 wrong input."""
    options = parser().parse_args(arguments)
    try:
        return {"run": run, "compare": compared, "verify": verified}[options.command](options)
    except (OSError, ValueError) as error:
        print(f"finite_elements: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
