"""Prints tables, aligned; as markdown they are the same with bars."""
import statistics
import sys

from race import ratios


class Printer:
    def __init__(self, markdown, file=sys.stdout):
        self.markdown = markdown
        self.file = file

    def line(self, text=""):
        print(text, file=self.file, flush=True)

    def title(self, text):
        self.line(f"# {text}\n" if self.markdown else f"{text}\n")

    def heading(self, text):
        self.line(f"## {text}\n" if self.markdown else text)

    def paragraph(self, text):
        self.line(f"{text}\n")

    def table(self, rows):
        """The first row is the head. Columns of words are aligned to the left: those whose head starts with a capital."""
        widths = [max(len(row[n]) for row in rows) for n in range(len(rows[0]))]
        is_words = [cell[:1].isupper() for cell in rows[0]]
        aligned = [[cell.ljust(width) if words else cell.rjust(width) for cell, width, words in zip(row, widths, is_words)]
                   for row in rows]
        if self.markdown:
            aligned.insert(1, ["-" * width if words else "-" * (width - 1) + ":" for width, words in zip(widths, is_words)])
        for row in aligned:
            self.line(f"| {' | '.join(row)} |" if self.markdown else "  ".join(row).rstrip())
        self.line()


LANE_HEAD = ("Case", "Program", "faces", "final", "seconds", "us/face", "peak MB")


def figures(lane):
    """The cells of LANE_HEAD from faces on."""
    if not lane.results:
        return (lane.absent, *("-" for _ in LANE_HEAD[3:]))
    result = lane.results[0]
    seconds = lane.median(lambda one: one.seconds)
    return (str(result.initial_faces), str(result.final_faces), f"{seconds:.3f}", f"{1e6 * seconds / result.initial_faces:.3f}",
            f"{lane.median(lambda one: one.peak_bytes) / 1e6:.0f}")


def ratio_cells(a, b, scale=1):
    """Median of the ratios of a's seconds to b's in the rounds, and the least and the greatest of them."""
    if not a.results or not b.results:
        return "-", "-"
    values = [scale * ratio for ratio in ratios(a, b)]
    return f"{statistics.median(values):.2f}", f"{min(values):.2f}-{max(values):.2f}"


def rms_cell(lane):
    return "-" if lane.rms is None else f"{lane.rms:.4f}"
