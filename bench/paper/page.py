"""The page of results, as markdown."""
import pathlib
import sys
import textwrap

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from tables import Printer  # noqa: E402: that of the other benchmarks


class Page(Printer):
    """Collects the rows of the summary while sections are written."""

    def __init__(self, file, pictures):
        super().__init__(True, file)
        self.pictures = pictures
        self.summaries = []

    def summary(self, section, what, paper, here, verdict):
        self.summaries.append((section, what, paper, here, verdict))

    def paragraph(self, text):
        """In lines of 120 characters, however it was broken; a line that begins with "- " begins a point of a list."""
        blocks = [" ".join(block.split()) for block in f"\n{text}".replace("\n- ", "\0- ").split("\0")]
        self.line("\n".join(textwrap.fill(block, 120, subsequent_indent="  " if block.startswith("- ") else "",
                                          break_long_words=False, break_on_hyphens=False) for block in blocks if block) + "\n")

    def picture(self, alt, name, caption=""):
        self.line(f"![{alt}](../../docs/pictures/{name})\n")
        if caption:
            self.paragraph(f"*{caption}*")

    def summary_table(self):
        self.table([("Section", "What", "The paper", "Here", "Verdict"), *self.summaries])
