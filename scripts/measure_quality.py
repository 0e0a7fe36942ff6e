#!/usr/bin/python3
"""Measures quality and bytes on the public stacks and writes the tables of docs/quality.md.

    scripts/measure_quality.py [--illum PROGRAM] [--shared FOLDER] [--stack NAME ...]
                               [--qualities 30,45,60,75,90] [--update docs/quality.md]

Each stack is built with --holdout 5, relit under every light and judged twice: by tests/cli/judge.py,
which shares no code with the program, and by `illum evaluate`, which must agree to 0.01 dB. A
stack with a `stack_test` folder beside it is also judged under the lights there.
"""

import argparse
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
JUDGE = ROOT / "tests/cli/judge.py"
HOLDOUT = 5
AGREEMENT_DECIBELS = 0.01
# Stacks whose files hold linear light without saying so.
LINEAR_STACKS = {"diligent_cat"}
# What the product promises against the best row of the peer (its held-out PSNR and bytes).
MOST_DECIBELS_BELOW = 0.5
MOST_BYTES_RATIO = 0.5


def call(*command):
    run = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{run.stderr}exit code {run.returncode}")
    return run.stdout


def best_peer_rows(table):
    """Stack -> the peer's row with the highest held-out PSNR."""
    best = {}
    with open(table, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file, delimiter="\t"):
            name, decibels = row["dataset"], float(row["psnr_heldout"])
            if name not in best or decibels > best[name]["psnr"]:
                best[name] = {"psnr": decibels, "bytes": int(row["bytes"]),
                              "what": f"{row['basis']} {row['planes']} q{row['quality']}"}
    return best


def stack_folders(shared, wanted):
    folders = [f for f in sorted((shared / "data").glob("*/stack")) if list(f.glob("*.lp"))]
    named = [f for f in folders if not wanted or f.parent.name in wanted]
    missing = set(wanted) - {f.parent.name for f in named}
    if missing:
        sys.exit(f"no such stack: {', '.join(sorted(missing))}")
    return named


class Measurement:
    """One object of one stack, built, relit and judged."""

    def __init__(self, illum, stack, work, options=()):
        self.illum, self.stack = illum, stack
        self.object = work / "object.illum"
        self.mask = stack.parent / "mask.png"
        self.input_options = ["--mask", self.mask] if self.mask.exists() else []
        if stack.parent.name in LINEAR_STACKS:
            self.input_options += ["--transfer", "linear"]
        call(illum, "build", stack, "-o", self.object, "--holdout", HOLDOUT, "--force",
             *self.input_options, *options)
        self.bytes = self.object.stat().st_size

    def judge(self, photographs, work, holdout):
        relit = work / f"relit_{photographs.name}"
        lights = next(photographs.glob("*.lp"))
        call(self.illum, "relight", self.object, "--lights", lights, "-o", relit, "--force")
        figures = json.loads(call(sys.executable, JUDGE, relit, photographs, "--holdout", holdout,
                                  *self.input_options, "--json"))
        self.check_agreement(photographs, figures)
        return figures

    def check_agreement(self, photographs, figures):
        own = json.loads(call(self.illum, "evaluate", self.object, "--against", photographs,
                              *self.input_options, "--json"))
        own_by_name = {light["name"]: light["psnr"] for light in own["lights"]}
        for light in figures["lights"]:
            apart = abs(light["psnr"] - own_by_name[light["name"]])
            if apart > AGREEMENT_DECIBELS:
                sys.exit(f"{photographs}: {light['name']}: judged {light['psnr']:.4f} dB, "
                         f"illum evaluate says {own_by_name[light['name']]:.4f}")


def verdict(held_out, size, peer):
    if peer is None:
        return "-"
    good = (held_out >= peer["psnr"] - MOST_DECIBELS_BELOW
            and size <= MOST_BYTES_RATIO * peer["bytes"])
    return "yes" if good else "**no**"


def stack_row(illum, stack, peers):
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        measured = Measurement(illum, stack, work)
        figures = measured.judge(stack, work, HOLDOUT)
        test = stack.parent / "stack_test"
        test_psnr = "-"
        if test.is_dir():
            test_psnr = f"{measured.judge(test, work, 1)['heldOut']['psnr']:.2f}"
    peer = peers.get(stack.parent.name)
    held_out, used = figures["heldOut"]["psnr"], figures["used"]["psnr"]
    return [stack.parent.name, f"{held_out:.2f}", f"{used:.2f}", test_psnr, f"{measured.bytes:,}",
            peer["what"] if peer else "-",
            f"{peer['psnr']:.2f}" if peer else "-", f"{peer['bytes']:,}" if peer else "-",
            verdict(held_out, measured.bytes, peer)]


def rate_row(illum, stack, qualities):
    cells = [stack.parent.name]
    for quality in qualities:
        with tempfile.TemporaryDirectory() as folder:
            work = pathlib.Path(folder)
            measured = Measurement(illum, stack, work, ["--quality", quality])
            figures = measured.judge(stack, work, HOLDOUT)
        cells.append(f"{figures['heldOut']['psnr']:.2f} / {figures['used']['psnr']:.2f} "
                     f"at {measured.bytes:,}")
        print(f"{cells[0]}, quality {quality}: {cells[-1]}", file=sys.stderr)
    return cells


def markdown(header, rows):
    rule = ["---"] + ["---:"] * (len(header) - 1)
    return "".join("| " + " | ".join(map(str, row)) + " |\n" for row in [header, rule, *rows])


def replace_table(document, name, table):
    """Between `<!-- NAME -->` and `<!-- end of NAME -->`."""
    text = document.read_text(encoding="utf-8")
    pattern = rf"(<!-- {name} -->\n).*?(<!-- end of {name} -->)"
    text, found = re.subn(pattern, lambda m: f"{m[1]}\n{table}\n{m[2]}", text, flags=re.S)
    if found != 1:
        sys.exit(f"{document}: expected one place for the table of {name}, found {found}")
    document.write_text(text, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--illum", type=pathlib.Path,
                        default=ROOT / "build/release/tools/illum/illum")
    parser.add_argument("--shared", type=pathlib.Path, default=ROOT.parent / "shared")
    parser.add_argument("--stack", action="append", default=[], help="only these; repeat for several")
    parser.add_argument("--qualities", default="30,45,60,75,90", help="of the second table; empty: none")
    parser.add_argument("--update", type=pathlib.Path, help="document whose tables are replaced")
    options = parser.parse_args()

    peers = best_peer_rows(options.shared / "peers/relight.tsv")
    stacks = stack_folders(options.shared, options.stack)
    rows = []
    for stack in stacks:
        rows.append(stack_row(options.illum, stack, peers))
        print(" ".join(rows[-1]), file=sys.stderr)
    tables = {"stacks": markdown(
        ["stack", "held out, dB", "used, dB", "test lights, dB", "bytes",
         "relight's best row", "its held out, dB", "its bytes", "kept"], rows)}
    qualities = [int(q) for q in options.qualities.split(",") if q]
    if qualities:
        tables["rate"] = markdown(
            ["stack", *(f"quality {q}" for q in qualities)],
            [rate_row(options.illum, stack, qualities) for stack in stacks])
    for name, table in tables.items():
        print(f"\n{table}")
        if options.update:
            replace_table(options.update, name, table)


if __name__ == "__main__":
    main()
