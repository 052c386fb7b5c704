"""Plots in one style."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot
import numpy

COLOURS = ("#1f5fa8", "#d9622b", "#3a9150", "#8c56a8", "#8a8a8a", "#c9a227", "#5bb5c9")
MARKERS = "osD^vPX"

matplotlib.rcParams.update({
    "font.size": 9, "axes.titlesize": 9.5, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
    "grid.color": "#dddddd", "grid.linewidth": 0.6, "lines.linewidth": 1.4, "lines.markersize": 4, "legend.frameon": False,
    "legend.fontsize": 8, "savefig.dpi": 110})


def panels(count, width=4.2, height=3.1):
    figure, axes = matplotlib.pyplot.subplots(1, count, figsize=(width * count, height), squeeze=False)
    return figure, axes[0]


def curve(axis, x, y, name=None, n=0, **style):
    axis.plot(x, y, color=COLOURS[n], marker=MARKERS[n], label=name, **style)


def say(axis, title="", x="", y="", logx=False, logy=False):
    axis.set(title=title, xlabel=x, ylabel=y)
    if logx:
        axis.set_xscale("log")
    if logy:
        axis.set_yscale("log")
    if axis.get_legend_handles_labels()[0]:
        axis.legend()


def save(figure, path):
    figure.tight_layout()
    figure.savefig(path, metadata={"Software": None})
    matplotlib.pyplot.close(figure)


def exponent(x, y):
    """Of the power law that fits best: the slope between logarithms."""
    return float(numpy.polyfit(numpy.log(x), numpy.log(y), 1)[0])
