"""--order best against --order paper over all examples and a few shapes: the scorecards side by side, and the gates.
Run as: plan_orders.py PROGRAM SOURCE_DIR. Exits 1 when a gate does not hold.

Gates: steps and exposure (+5 %) on no model worse; in total: removals at most half, inserts with one neighbour -25 %,
view turns -35 %, exposure lower.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SHAPES = ["ball-90", "torus-12x6", "checker-120"]
KEYS = ["steps", "removals", "exposure", "one_neighbour_inserts", "four_at_once_inserts", "negative_defect_inserts",
        "view_turns", "minutes"]


def scorecard(program, design, order):
    result = subprocess.run([program, "plan", design, "--order", order, "--json"], capture_output=True, text=True,
                            check=True)
    return json.loads(result.stdout)["scorecard"]


def designs(source, folder):
    yield from sorted((source / "examples").glob("*.json"))
    for shape in SHAPES:
        file = folder / f"{shape}.json"
        file.write_text(json.dumps({"rhombloom": 1, "operations": [{"op": "place", "id": "body", "shape": shape}]}))
        yield file


def main():
    program, source = sys.argv[1], Path(sys.argv[2])
    totals = {order: dict.fromkeys(KEYS, 0) for order in ("paper", "best")}
    ok = True
    print(f"{'model':12} {'order':6} " + " ".join(f"{key[:12]:>12}" for key in KEYS))
    with tempfile.TemporaryDirectory() as folder:
        for design in designs(source, Path(folder)):
            cards = {order: scorecard(program, design, order) for order in totals}
            for order, card in cards.items():
                print(f"{design.stem:12} {order:6} " + " ".join(f"{card[key]:12}" for key in KEYS))
                for key in KEYS:
                    totals[order][key] += card[key]
            ok &= cards["best"]["steps"] <= cards["paper"]["steps"]
            ok &= cards["best"]["exposure"] <= 1.05 * cards["paper"]["exposure"]
    for order, card in totals.items():
        print(f"{'total':12} {order:6} " + " ".join(f"{round(card[key], 1):12}" for key in KEYS))
    paper, best = totals["paper"], totals["best"]
    ok &= best["removals"] <= 0.5 * paper["removals"] and best["exposure"] < paper["exposure"]
    ok &= best["one_neighbour_inserts"] <= 0.75 * paper["one_neighbour_inserts"]
    ok &= best["view_turns"] <= 0.65 * paper["view_turns"]
    print("gates hold" if ok else "a gate does NOT hold")
    return 0 if ok else 1


if __name__ == "__main__":
    sys.exit(main())
