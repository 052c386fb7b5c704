"""Prints tables, aligned; as markdown they are the same with bars."""
from race import ratios


class Printer:
    def __init__(self, markdown):
        self.markdown = markdown

    def title(self, text):
        print(f"# {text}\n" if self.markdown else f"{text}\n", flush=True)

    def heading(self, text):
        print(f"## {text}\n" if self.markdown else text, flush=True)

    def paragraph(self, text):
        print(f"{text}\n", flush=True)

    def table(self, rows):
        """The first row is the head. Columns of words are aligned to the left: those whose head starts with a capital."""
        widths = [max(len(row[n]) for row in rows) for n in range(len(rows[0]))]
        is_words = [cell[:1].isupper() for cell in rows[0]]
        aligned = [[cell.ljust(width) if words else cell.rjust(width) for cell, width, words in zip(row, widths, is_words)]
                   for row in rows]
        if self.markdown:
            aligned.insert(1, ["-" * width if words else "-" * (width - 1) + ":" for width, words in zip(widths, is_words)])
        for row in aligned:
            print(f"| {' | '.join(row)} |" if self.markdown else "  ".join(row).rstrip())
        print(flush=True)


LANE_HEAD = ("Case", "Program", "faces", "final", "seconds", "us/face", "peak MB")


def figures(lane):
    """The cells of LANE_HEAD from faces on."""
    if not lane.results:
        return (lane.absent, *("-" for _ in LANE_HEAD[3:]))
    result = lane.results[0]
    seconds = lane.median(lambda one: one.seconds)
    return (str(result.initial_faces), str(result.final_faces), f"{seconds:.3f}", f"{1e6 * seconds / result.initial_faces:.3f}",
            f"{lane.median(lambda one: one.peak_bytes) / 1e6:.0f}")


def ratio_cells(first, lane):
    """Median of the ratios of the rounds, and the least and the greatest of them."""
    if not first.results or not lane.results:
        return "-", "-"
    values = sorted(ratios(first, lane))
    middle = (values[(len(values) - 1) // 2] + values[len(values) // 2]) / 2
    return f"{middle:.2f}", f"{values[0]:.2f}-{values[-1]:.2f}"


def rms_cell(lane):
    return "-" if lane.rms is None else f"{lane.rms:.4f}"
