"""P 4.7, Fig. 11 and 12: sections of 50 x 50 to 50 x 1000 samples, and how much is taken away."""
import plots
from lab import ALL_REGIONS, AS_IN_PAPER, in_core_verdict, median, race, seconds, total

TITLE = "Linear growth, and how much is taken away (P 4.7, Fig. 11 and 12)"
LENGTHS = (50, 100, *range(200, 1001, 100))
SHARES = (10, 25, 50, 75)  # percent of the faces that remain
WAYS = ("on the fly", "in core")
ROUNDS = 5
ONE_THREAD = ("--threads", "1")  # as the paper's computer


def in_core(lab, volume, remove):
    """All faces first, then decimation of them all."""
    full = lab.reconstruct(volume, "--no-decimate", *AS_IN_PAPER, *ALL_REGIONS, *ONE_THREAD, model="full.ply")
    done = lab.decimate("full.ply", "--reduce", remove, *ALL_REGIONS, *ONE_THREAD, to="less.ply")
    return {"total": total(full) + seconds(done), "decimation": seconds(done), "faces": full["initial_faces"]}


def on_the_fly(lab, volume, remove):
    report = lab.reconstruct(volume, "--reduce", remove, *AS_IN_PAPER, *ALL_REGIONS, *ONE_THREAD, model="less.ply")
    return {"total": total(report), "decimation": seconds(report), "faces": report["initial_faces"]}


def measure(lab):
    rows = []
    for length in LENGTHS:
        volume = lab.volume(f"mgo_50x{length}.npy")
        for share in SHARES:
            remove = f"{100 - share}%"
            runs = race({"on the fly": lambda: on_the_fly(lab, volume, remove), "in core": lambda: in_core(lab, volume, remove)}, ROUNDS)
            row = {"length": length, "remain": share, "faces": runs["in core"][0]["faces"]}
            for way, results in runs.items():
                for what in ("total", "decimation"):
                    row[f"{way}, {what}"] = median(results, lambda one: one[what])
            rows.append(row)
    return rows


def of_share(rows, share, key):
    return [row[key] for row in rows if row["remain"] == share]


def write(page, rows):
    figure, axes = plots.panels(2)
    for n, way in enumerate(WAYS):
        for what, style in (("total", "-"), ("decimation", "--")):
            plots.curve(axes[0], of_share(rows, 10, "faces"), of_share(rows, 10, f"{way}, {what}"), f"{way}, {what}", n, linestyle=style)
    plots.say(axes[0], "to 10 %", "faces", "seconds")
    for n, share in enumerate(SHARES):
        plots.curve(axes[1], of_share(rows, share, "faces"), of_share(rows, share, "on the fly, total"), f"{share} % on the fly", n)
        plots.curve(axes[1], of_share(rows, share, "faces"), of_share(rows, share, "in core, total"), f"{share} % in core", n, linestyle="--",
                    alpha=0.6)
    plots.say(axes[1], "from 10 to 75 % of the faces remain", "faces", "seconds in all")
    plots.save(figure, page.pictures / "growth.png")

    tenth = [row for row in rows if row["remain"] == 10]
    table = [("samples", "faces", "on the fly, s", "of that decimation", "us a face", "in core, s", "of that decimation", "us a face")]
    for row in tenth:
        cells = []
        for way in WAYS:
            cells += [f"{row[f'{way}, total']:.3f}", f"{row[f'{way}, decimation']:.3f}", f"{1e6 * row[f'{way}, total'] / row['faces']:.2f}"]
        table.append((f"50 x {row['length']} x 5", str(row["faces"]), *cells))
    slope = {way: plots.exponent(of_share(rows, 10, "faces"), of_share(rows, 10, f"{way}, total")) for way in WAYS}
    page.picture("Seconds against faces", "growth.png", "One thread, medians of five runs. Left: Fig. 11. Right: Fig. 12.")
    page.table(table)
    largest = {row["remain"]: row for row in rows if row["length"] == LENGTHS[-1]}
    page.table([("remain, of 50 x 1000 x 5", "on the fly, s", "in core, s", "in core / on the fly"),
                *((f"{share} %", f"{row['on the fly, total']:.3f}", f"{row['in core, total']:.3f}",
                   f"{row['in core, total'] / row['on the fly, total']:.2f}") for share, row in largest.items())])
    page.paragraph(f"Growth is linear: the time to a tenth goes as N^{slope['on the fly']:.2f} on the fly and N^{slope['in core']:.2f} in core. The\n"
                   "paper's computer took nearly linear time, too, and says no worse than N log N.")
    ratios = [row["in core, total"] / row["on the fly, total"] for row in largest.values()]
    page.paragraph("The paper is faster on the fly than in core, since its heaps are smaller. Here decimation in core works tile by tile,\n"
                   f"too, and takes {min(ratios):.2f} to {max(ratios):.2f} times the seconds.")
    tenth, quarter, half = (largest[share]["on the fly, total"] for share in (10, 25, 50))
    verdict = ("falls short: a half takes longer" if half > 1.1 * tenth else "agrees" if half > 0.8 * tenth else "a half is quicker")
    page.paragraph(f"The paper finds little difference between 10, 25 and 50 % on the fly. Here they take {tenth:.2f}, {quarter:.2f} and\n"
                   f"{half:.2f} s: " + {"agrees": "little difference, too.", "a half is quicker": "a tenth and a quarter differ little, a half is quicker."}.get(
                       verdict, "a half takes longer than a tenth. This falls short."))
    page.summary("4.7", "growth, 50 x 50 to 50 x 1000", "nearly linear", f"N^{slope['on the fly']:.2f}", "agrees")
    page.summary("4.7", "in core, seconds against on the fly", "more", f"{min(ratios):.2f} to {max(ratios):.2f} times",
                 in_core_verdict(ratios))
    page.summary("4.7", "10, 25, 50 % on the fly", "little difference", f"{tenth:.2f}, {quarter:.2f}, {half:.2f} s", verdict)
