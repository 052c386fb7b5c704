"""Progress: a callable, or a bar by tqdm."""

import contextlib


class _Bars:
    """One bar for each stage."""

    def __init__(self, tqdm):
        self.tqdm, self.bar, self.stage = tqdm, None, None

    def __call__(self, stage, done, total):
        if stage != self.stage:
            self.close()
            self.bar, self.stage = self.tqdm(desc=stage, total=total, leave=False), stage
        if total != self.bar.total:
            self.bar.total = total
        self.bar.update(done - self.bar.n)

    def close(self):
        if self.bar is not None:
            self.bar.close()


@contextlib.contextmanager
def bar(progress):
    """The callable that the run gets, or None."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            yield None
            return
        with contextlib.closing(_Bars(tqdm)) as bars:
            yield bars
    elif callable(progress):
        yield progress
    else:
        raise TypeError(f"progress={progress!r}: give True, False or a callable")
