"""What a share of the faces costs: distance, quality and volume, for five kinds of data."""
import plots
from lab import ALL_REGIONS, TAUBIN, total

TITLE = "Which --reduce? Quality at a given number of faces"
VOLUMES = {"atlas": ("aal.npy", "AAL brain atlas, 117 labels"),
           "head": ("zubal_head.npy", "head phantom from MRI, 58 labels"),
           "body": ("totalseg_ct20.npy", "body from CT, 32 labels, 20 sections of 512 x 512"),
           "grains": ("in100_60x80x100.npy", "IN100, nickel alloy from EBSD, 373 labels"),
           "neurons": ("connectomics_a128_u32.npy", "neurons from electron microscopy, 167 labels")}
SHARES = (50, 35, 25, 15, 10, 7, 5, 3, 2, 1, 0.5, 0)  # percent that remain; 0: the limit
SMALL = 1000  # samples: what is smaller is left out of the largest change


def volume_change(report, full):
    """Sum of all regions' changes over all volume, and the largest relative change of a region that is not small."""
    before = {region["label"]: region["volume"] for region in full["regions"]}
    changes = {region["label"]: abs(region["volume"] - before[region["label"]]) for region in report["regions"]}
    large = [changes[label] / volume for label, volume in before.items() if volume > SMALL]
    return sum(changes.values()) / sum(before.values()), max(large, default=0)


def measure(lab):
    results = {}
    for name, (file, _) in VOLUMES.items():
        volume = lab.volume(file)
        full = lab.reconstruct(volume, "--no-decimate", *TAUBIN, *ALL_REGIONS, model="full.vtp")
        rows = [{"remain": 100, "faces": full["final_faces"], "rms": 0, "max": 0, "least": full["quality"]["min"],
                 "mean": full["quality"]["mean"], "volume": 0, "volume_max": 0, "seconds": total(full), "stopped": full["stopped"]}]
        for share in SHARES:
            report = lab.reconstruct(volume, "--reduce", f"{100 - share}%", *TAUBIN, *ALL_REGIONS)
            distance = lab.compare("full.vtp", "model.vtp", *ALL_REGIONS)["distance"]["both"]
            drift, worst = volume_change(report, full)
            rows.append({"remain": 100 * report["final_faces"] / full["final_faces"], "faces": report["final_faces"], "rms": distance["rms"],
                         "max": distance["max"], "least": report["quality"]["min"], "mean": report["quality"]["mean"], "volume": drift,
                         "volume_max": worst, "seconds": total(report), "stopped": report["stopped"],
                         "violations": sum(report["violation_counts"].values())})
            if report["stopped"] == "topology":
                break
        results[name] = rows
    return results


def plot(page, name, rows):
    figure, axes = plots.panels(3, 3.4, 2.8)
    x, less = [row["faces"] for row in rows], [row["faces"] for row in rows[1:]]
    plots.curve(axes[0], less, [row["rms"] for row in rows[1:]], "rms")
    plots.curve(axes[0], less, [row["max"] for row in rows[1:]], "largest", 1)
    plots.say(axes[0], "distance to the full model", "faces", "samples", True, True)
    plots.curve(axes[1], x, [row["mean"] for row in rows], "mean")
    plots.curve(axes[1], x, [row["least"] for row in rows], "least", 1)
    axes[1].set_ylim(0, 0.27)
    plots.say(axes[1], "quality of faces", "faces", "Q", True)
    plots.curve(axes[2], less, [100 * row["volume"] for row in rows[1:]], "all regions")
    plots.curve(axes[2], less, [100 * row["volume_max"] for row in rows[1:]], f"worst above {SMALL} samples", 1)
    plots.say(axes[2], "change of volume", "faces", "%", True, True)
    plots.save(figure, page.pictures / f"curve-{name}.png")


def at(rows, share):
    return next((row for row in rows if abs(row["remain"] - share) < 0.05 * share), None)


def write(page, results):
    page.paragraph("Each model is smoothed (20 passes of taubin) and then decimated, and compared with the smoothed model of all faces. Distances are\n"
                   "both ways, in samples. Change of volume: the sum of what regions win or lose, over all volume; and the worst region\n"
                   f"of more than {SMALL} samples. Every sample stays in its region, as by default. The last point of each curve is the limit:\n"
                   "nothing more can be collapsed.")
    for name, (_, words) in VOLUMES.items():
        plot(page, name, results[name])
        page.picture(f"Distance, quality and volume against faces: {words}", f"curve-{name}.png", f"{words[0].upper()}{words[1:]}.")
    table = [("Data", "faces", "remain", "rms", "largest", "least Q", "mean Q", "volume, %", "worst region, %", "seconds")]
    for name, rows in results.items():
        shown = [row for row in (at(rows, share) for share in (50, 25, 10, 5, 2)) if row] + [rows[-1]]
        for row in shown:
            table.append((name, str(row["faces"]), "limit" if row is rows[-1] else f"{row['remain']:.0f} %", f"{row['rms']:.4f}",
                          f"{row['max']:.2f}", f"{row['least']:.3f}", f"{row['mean']:.3f}", f"{100 * row['volume']:.3f}",
                          f"{100 * row['volume_max']:.2f}", f"{row['seconds']:.2f}"))
    page.table(table)
    half, tenth = ([at(rows, share)["rms"] for rows in results.values()] for share in (50, 10))
    first, last = ([rows[n]["mean"] for rows in results.values()] for n in (0, -1))
    limits = [rows[-1]["remain"] for rows in results.values()]
    page.paragraph(f"To choose: half of the faces is {max(half):.3f} samples (rms) from all of them at most, a tenth {min(tenth):.2f} to {max(tenth):.2f}, less than the\n"
                   "steps of the samples that smoothing takes away. From there distance grows about as faces go, and faster in the end. The\n"
                   "largest distance is that of thin and tiny parts, and comes early; so does the change of small regions.\n"
                   "`--preserve-volume` takes that back. The mean quality falls from "
                   f"{max(first):.2f} at most to {min(last):.2f} at the limit, and no face falls below the bound of 0.1. The limit lies between\n"
                   f"{min(limits):.1f} and {max(limits):.1f} % of the faces: where many small regions meet it comes soon.")
    page.summary("all", "violations in all models of the curves", "none",
                 str(sum(row.get("violations", 0) for rows in results.values() for row in rows) or "none"), "agrees")
