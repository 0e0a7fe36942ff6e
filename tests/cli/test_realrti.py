"""The public stacks: held-out quality and bytes against the best known peer."""

import csv
import json

import pytest

from conftest import shared_data
from test_judging import judged

STACKS = ["realrti01_door", "realrti03_icon_michele", "realrti08_clay_shell", "realrti09_coin_a",
          "realrti11_metal_statue_a"]


def best_peer_row(stack):
    with open(shared_data("peers", "relight.tsv")) as table:
        rows = [row for row in csv.DictReader(table, delimiter="\t") if row["dataset"] == stack]
    return max(rows, key=lambda row: float(row["psnr_heldout"]))


@pytest.mark.shared
@pytest.mark.parametrize("stack", STACKS)
def test_held_out_quality_at_half_the_bytes(illum, tmp_path, stack):
    photographs = shared_data("data", stack, "stack")
    peer = best_peer_row(stack)
    out = tmp_path / "o.illum"
    illum("build", photographs, "-o", out, "--holdout", 5)
    illum("relight", out, "--lights", photographs / "lights.lp", "-o", tmp_path / "relit")
    figures = judged(tmp_path / "relit", photographs, "--holdout", "5")
    held_out, size = figures["heldOut"]["psnr"], out.stat().st_size
    said = f"{stack}: {held_out:.2f} dB, {size} bytes; peer {peer}"
    print(said)
    assert held_out >= float(peer["psnr_heldout"]) - 0.5, said
    assert size <= int(peer["bytes"]) / 2, said
    ours = json.loads(illum("evaluate", out, "--against", photographs, "--json").stdout)
    assert ours["heldOut"]["psnr"] == pytest.approx(held_out, abs=0.01)
