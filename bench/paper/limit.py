"""P 4.8 and 3.7, Fig. 13: how far decimation goes, and what stops it."""
import plots
from lab import ALL_REGIONS, AS_IN_PAPER, median, refused, seconds, total

TITLE = "The limit of decimation (P 4.8, Fig. 13)"
VOLUME = "mgo_50x1000.npy"
SHARES = (75, 60, 50, 45, 40, 35, 30, 25, 20, 15, 12, 10, 8, 6, 5, 4, 3, 2, 1.5, 1, 0)  # percent that remain; 0: the limit
PAPER_LIMIT, PAPER_FOLDS = 12, 54
ROUNDS = 3
ONE_THREAD = ("--threads", "1")
VERDICTS = ("fold", "quality", "link", "pinch", "intersect")


def run(lab, share, model="model.ply"):
    return lab.reconstruct(lab.volume(VOLUME), "--reduce", f"{100 - share}%", *AS_IN_PAPER, *ALL_REGIONS, *ONE_THREAD, model=model)


def stretch(lab, begin, end):
    """Verdicts on the way from one share of the faces to another."""
    faces = run(lab, begin, "begin.ply")["initial_faces"]
    done = lab.decimate("begin.ply", "--target-faces", round(faces * end / 100), *ALL_REGIONS, *ONE_THREAD, to="end.ply")
    return {"begin": begin, "end": 100 * done["final_faces"] / faces, "verdicts": done["verdicts"], "refreshes": done["refreshes"],
            "seconds": seconds(done), "faces_removed": done["initial_faces"] - done["final_faces"]}


def measure(lab):
    rows = []
    for share in SHARES:
        reports = [run(lab, share) for _ in range(ROUNDS)]
        first = reports[0]
        rows.append({"asked": share, "remain": 100 * first["final_faces"] / first["initial_faces"], "faces": first["final_faces"],
                     "initial": first["initial_faces"], "seconds": median(reports), "decimation": median(reports, seconds),
                     "verdicts": first["verdicts"], "refreshes": first["refreshes"], "stopped": first["stopped"]})
    return {"rows": rows, "stretches": [stretch(lab, *ends) for ends in ((100, 50), (50, 12), (12, 4), (4, 2), (2, 0))]}


def write(page, results):
    rows, stretches = results["rows"], results["stretches"]
    figure, axes = plots.panels(2)
    plots.curve(axes[0], [row["remain"] for row in rows], [row["seconds"] for row in rows], "in all")
    plots.curve(axes[0], [row["remain"] for row in rows], [row["decimation"] for row in rows], "decimation", 1)
    axes[0].axvline(PAPER_LIMIT, color="#999999", linestyle=":")
    axes[0].set_ylim(bottom=0)
    plots.say(axes[0], "five sections of 50 x 1000", "faces that remain, %", "seconds")
    names = [f"{one['begin']:g} to {one['end']:.2g} %" for one in stretches]
    low = [0.0] * len(stretches)
    for n, verdict in enumerate(VERDICTS):
        shares = [100 * refused(one["verdicts"])[verdict] for one in stretches]
        axes[1].bar(names, shares, bottom=low, color=plots.COLOURS[n], label=verdict, width=0.7)
        low = [a + b for a, b in zip(low, shares)]
    axes[1].tick_params(axis="x", labelrotation=20)
    axes[1].grid(axis="x", visible=False)
    axes[1].set_title("why edges were refused")
    axes[1].set_ylabel("% of those refused")
    axes[1].legend(loc="center left", bbox_to_anchor=(1, 0.5))
    plots.save(figure, page.pictures / "limit.png")

    page.picture("Seconds against what remains, and why edges were refused", "limit.png",
                 "Left: one thread; the dotted line is the paper's limit. Right: each stretch from where the one before ended.")
    table = [("asked, %", "faces", "remain, %", "seconds", "refreshes", "accepted", *VERDICTS, "Stopped by")]
    for row in rows:
        if row["asked"] in (75, 50, 25, 12, 10, 5, 2, 1, 0):
            table.append((f"{row['asked']:g}", str(row["faces"]), f"{row['remain']:.2f}", f"{row['seconds']:.3f}", str(row["refreshes"]),
                          str(row["verdicts"]["accepted"]), *(str(row["verdicts"][v]) for v in VERDICTS), row["stopped"]))
    page.table(table)
    last = rows[-1]
    below = [one for one in stretches if one["begin"] <= PAPER_LIMIT]
    counts = {v: sum(one["verdicts"][v] for one in below) for v in VERDICTS}
    whole = sum(counts.values())
    folds = 100 * counts["fold"] / whole
    most = max(counts, key=counts.get)
    every = sum(one["verdicts"]["accepted"] for one in below) / (whole + sum(one["verdicts"]["accepted"] for one in below))
    slowest, at_paper = max(rows, key=lambda row: row["seconds"]), next(row for row in rows if row["asked"] == PAPER_LIMIT)
    page.table([("Stretch", "accepted", "refused", *(f"{v}, %" for v in VERDICTS), "refreshes", "us a face removed"),
                *((names[n], str(one["verdicts"]["accepted"]), str(sum(one["verdicts"][v] for v in VERDICTS)),
                   *(f"{100 * refused(one['verdicts'])[v]:.1f}" for v in VERDICTS), str(one["refreshes"]),
                   f"{1e6 * one['seconds'] / max(one['faces_removed'], 1):.1f}") for n, one in enumerate(stretches))])
    page.paragraph(f"The paper's process stops paying at {PAPER_LIMIT} % of the faces, where most edges left cannot be contracted. Here the\n"
                   f"same kind of model goes to {last['remain']:.2f} %, {last['faces']} faces, before nothing can be collapsed: topology, shape and\n"
                   "crossing forbid the rest, and exactly that is proved edge by edge. The whole way takes\n"
                   f"{last['seconds'] / at_paper['seconds']:.2f} times the seconds of the way to {PAPER_LIMIT} %.")
    page.paragraph(f"In the paper {PAPER_FOLDS} % of the edges were refused because faces would turn over, edges refused again counted again. Here,\n"
                   f"below {PAPER_LIMIT} % of the faces, folds are {folds:.0f} % of the refusals, and "
                   + ("no verdict is more frequent" if most == "fold" else f"*{most}* is the most frequent with {100 * counts[most] / whole:.0f} %")
                   + f"; {100 * every:.0f} % of\nthe edges tried there are collapsed. Verdicts are told in the order link, fold, quality, pinch, intersect, and each edge\n"
                   "counts under the first that fails. Edges between strata that do not fit are never tried, and not counted here.")
    page.paragraph("Time grows with what is taken away"
                   + (f", but for a bump: {slowest['asked']:g} % takes longest. What goes first costs nothing, so that cost levels tell nothing\n"
                      "([why](../../docs/explanation/performance.md))." if slowest["asked"] > 15 else "; beyond the paper's 45 % it stays nearly level, as there."))
    page.summary("4.8", "limit of decimation", f"about {PAPER_LIMIT} %", f"{last['remain']:.2f} %", "beaten")
    page.summary("3.7", "share of folds in refusals", f"{PAPER_FOLDS} %", f"{folds:.0f} % below {PAPER_LIMIT} %",
                 "agrees roughly" if abs(folds - PAPER_FOLDS) < 15 else f"contradicted: {most} leads" if most != "fold" else "less")
