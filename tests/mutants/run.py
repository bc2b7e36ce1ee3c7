#!/usr/bin/env python3
"""Changes the library on purpose and sees whether its tests notice, by `cargo mutants`.

A mutant is known by its file, its function, the change and which of several alike it is, not by its line: so a sample
stays the same while other code changes. The sample is the mutants whose hash with the seed is smallest, so a larger one
holds a smaller one. Unit tests see every mutant; those they miss go to the other tests, the slower ones last.

    run.py --sample 300     what is not yet in results.csv, resumable at any time
    run.py --fixed          the mutants of fixed.txt, each of which must be caught

Either asks first whether a mutant that changes no result is missed, as it must be.
"""

import argparse
import csv
import hashlib
import itertools
import json
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
RESULTS = HERE / "results.csv"
SEED = "pd-verify 1"
# Physics, forces, marching, comparing, extraction.
FILES = """kernel material micromodulus partial_volume family lattice quadrature dispersion/* forces/** constraints/**
    grid field connectivity obstacles breaking/** model march/** statics fastest ledger compare/** claim verdict
    stress_intensity/**""".split()
# Tests by rising cost, and the seconds after which a mutant that still runs counts as caught.
STAGES = {
    "unit": (["--lib"], 60),
    "marches": (["--test", "march", "--test", "schemes", "--test", "properties", "--test", "ledger"], 240),
    "conformance": (["--test", "conformance", "--test", "invariant", "--test", "fastest"], 400),
}
AWAITS = "awaits "
# Skips a short cut and changes no result, so no test may fail: where one does, tests fail by themselves, or judging is
# at fault, and nothing counts as caught.
CONTROL = "src/connectivity.rs: replace Connectivity<D>::intact -> bool with false #1"
# A mutant may ask for memory without end.
MEMORY = 12 << 30


def cargo_mutants(files, arguments):
    return subprocess.run(
        ["cargo", "mutants", *(word for file in files for word in ("-f", file)), *arguments],
        cwd=ROOT,
        text=True,
        capture_output=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY)),
    )


def listed():
    """All mutants, by what they are known by. The control must be among them."""
    files = [f"src/{name}" if name.endswith("*") else f"src/{name}.rs" for name in FILES]
    ran = cargo_mutants(files, ["--list", "--json"])
    if ran.returncode:
        sys.exit(ran.stderr)
    mutants, alike = {}, {}
    for mutant in json.loads(ran.stdout):
        known = re.sub(r":\d+:\d+:", ":", mutant["name"], count=1)
        alike[known] = alike.get(known, 0) + 1
        mutants[f"{known} #{alike[known]}"] = mutant["name"]
    if CONTROL not in mutants:
        sys.exit(f"no such mutant any more; choose another that changes no result: {CONTROL}")
    return mutants


def sampled(mutants, count):
    return sorted(mutants, key=lambda known: hashlib.sha256(f"{SEED} {known}".encode()).digest())[:count]


def file_of(known):
    return known.split(":", 1)[0]


def outcomes(file, names, tests, timeout):
    """By name: caught, missed, timeout or unviable. Mutants of the file that delete a field are judged too: no pattern
    of names holds them back."""
    pattern = "^(" + "|".join(re.escape(name) for name in names) + ")$"
    with tempfile.TemporaryDirectory() as folder:
        ran = cargo_mutants(
            [file],
            ["--in-place", "--re", pattern, "-o", folder, "--baseline", "skip", "--timeout", str(timeout),
             "--profile", "mutants", "--no-shuffle", "--colors", "never", *(f"-C={word}" for word in tests)],
        )
        out = Path(folder) / "mutants.out"
        found = {}
        for outcome in ["caught", "missed", "timeout", "unviable"]:
            listing = out / f"{outcome}.txt"
            for name in listing.read_text().splitlines() if listing.exists() else []:
                found[name] = outcome
    lost = sorted(set(names) - set(found))
    if lost:
        sys.exit(f"cargo mutants ended with {ran.returncode} and no outcome of {lost}\n{ran.stdout[-2000:]}\n"
                 f"{ran.stderr[-2000:]}")
    return found


def judged(stage, names, mutants):
    """File by file and by mutant: the stage that caught it, `unviable`, or what it has yet to pass."""
    tests, timeout = STAGES[stage]
    control = outcomes(file_of(CONTROL), [mutants[CONTROL]], tests, timeout)[mutants[CONTROL]]
    if control != "missed":
        sys.exit(f"{stage}: {CONTROL} changes no result and is {control}: do the tests pass unchanged?")
    order = [*STAGES, None]
    following = order[order.index(stage) + 1]
    missed = f"{AWAITS}{following}" if following else "survived"
    said = {"caught": stage, "timeout": f"{stage}, by its time", "missed": missed}
    for file, alike in itertools.groupby(sorted(names), file_of):
        alike = list(alike)
        found = outcomes(file, [mutants[known] for known in alike], tests, timeout)
        yield {known: said.get(found[mutants[known]], found[mutants[known]]) for known in alike}


def read():
    if not RESULTS.exists():
        return {}
    with RESULTS.open(newline="") as file:
        return {row["mutant"]: row for row in csv.DictReader(file)}


def write(rows):
    written = RESULTS.with_suffix(".part")
    with written.open("w", newline="") as file:
        writer = csv.DictWriter(file, ["mutant", "outcome", "reason"], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows[known] for known in sorted(rows))
    written.replace(RESULTS)


def summary(rows):
    viable = [row for row in rows if row["outcome"] != "unviable"]
    survivors = [row for row in viable if row["outcome"] == "survived"]
    caught = len(viable) - len(survivors)
    print(f"{len(rows)} mutants, {len(viable)} viable, {caught} caught: {caught / max(1, len(viable)):.1%}")
    for row in survivors:
        print(f"survived: {row['mutant']}: {row['reason'] or 'no reason given'}")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    which = options.add_mutually_exclusive_group(required=True)
    which.add_argument("--sample", type=int, metavar="COUNT")
    which.add_argument("--fixed", action="store_true")
    options = options.parse_args()
    mutants = listed()
    if options.fixed:
        fixed = (HERE / "fixed.txt").read_text().splitlines()
        unknown = [known for known in fixed if known not in mutants]
        if unknown:
            sys.exit("no such mutants any more; choose others of their kind in fixed.txt:\n" + "\n".join(unknown))
        results = {known: outcome for part in judged("unit", fixed, mutants) for known, outcome in part.items()}
        for known in fixed:
            print(f"{results[known]}: {known}")
        lost = [known for known in fixed if not results[known].startswith("unit")]
        sys.exit(f"{len(lost)} of {len(fixed)} mutants were not caught" if lost else 0)
    sample, rows = sampled(mutants, options.sample), read()
    print(f"{len(mutants)} mutants in all, {len(sample)} in the sample", flush=True)
    for stage in STAGES:
        fresh = {"outcome": f"{AWAITS}{next(iter(STAGES))}"}
        left = [known for known in sample if rows.get(known, fresh)["outcome"] == f"{AWAITS}{stage}"]
        if not left:
            continue
        done = 0
        for part in judged(stage, left, mutants):
            for known, outcome in part.items():
                rows[known] = {"mutant": known, "outcome": outcome, "reason": ""}
            write(rows)
            done += len(part)
            print(f"{stage}: {done} of {len(left)} done", flush=True)
    summary([rows[known] for known in sample])


if __name__ == "__main__":
    main()
