"""Progress, interrupts, exceptions, threads, memory."""

import gc
import os
import signal
import subprocess
import sys
import threading
import time
import weakref

import numpy as np
import pytest

import regionmesh


@pytest.fixture(scope="module")
def large():
    """Work of some seconds."""
    random = np.random.default_rng(1)
    coarse = random.integers(1, 60, (20, 20, 20)).astype(np.uint8)
    return coarse.repeat(4, 0).repeat(4, 1).repeat(4, 2)


def test_a_callable_gets_stage_done_and_total(grains):
    calls = []
    regionmesh.reconstruct(grains, reduce=0.5, progress=lambda *call: calls.append(call))
    stages = [stage for stage, _, _ in calls]
    assert stages[:2] == ["denoise", "count"] and stages[-1] == "samples"
    assert {"count", "reconstruct", "decimate", "check", "samples"} <= set(stages)
    for _, done, total in calls:
        assert isinstance(done, int) and (total is None or 0 <= done <= total)


def test_progress_runs_on_the_thread_of_the_caller(grains):
    threads = set()
    regionmesh.reconstruct(grains, progress=lambda *_: threads.add(threading.get_ident()))
    assert threads == {threading.get_ident()}


def test_progress_true_shows_a_bar(grains, capsys):
    pytest.importorskip("tqdm")
    regionmesh.reconstruct(grains, progress=True)
    assert "reconstruct" in capsys.readouterr().err


def test_progress_true_works_without_tqdm(grains, monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm", None)
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    assert regionmesh.reconstruct(grains, progress=True).certified


def test_an_exception_of_the_callable_comes_through(grains):
    class Enough(Exception):
        pass

    def stop(stage, done, total):
        if stage == "reconstruct":
            raise Enough("here")

    with pytest.raises(Enough, match="here"):
        regionmesh.reconstruct(grains, progress=stop)


@pytest.mark.parametrize("delay", [0.05, 0.6, 1.5])
def test_ctrl_c_ends_a_run_within_a_second(large, delay):
    pressed = []

    def press():
        pressed.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(delay, press)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        while True:  # also where one run is done before the key is pressed
            regionmesh.reconstruct(large, background=None, reduce=0.9)
    assert time.monotonic() - pressed[0] < 1.0


def test_ctrl_c_ends_voxelise(grains):
    mesh = regionmesh.reconstruct(grains)
    pressed = []

    def press():
        pressed.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    threading.Timer(0.2, press).start()
    with pytest.raises(KeyboardInterrupt):
        while True:
            mesh.voxelise(shape=(500, 500, 500), spacing=[1 / 25] * 3, dtype="u1")
    assert time.monotonic() - pressed[0] < 1.0


def test_runs_of_daemon_threads_end_with_the_interpreter():
    script = """
import threading, time
import numpy as np, regionmesh
labels = np.random.default_rng(1).integers(1, 60, (20, 20, 20)).astype("u1").repeat(4, 0).repeat(4, 1).repeat(4, 2)
def run(made):
    while True:
        regionmesh.reconstruct(made(), background=None, sections=len(labels))
for made in (lambda: iter(labels)), (lambda: iter(labels)):
    threading.Thread(target=run, args=(made,), daemon=True).start()
time.sleep(0.3)
"""
    for _ in range(3):
        ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
        assert (ended.returncode, ended.stderr) == (0, "")


@pytest.mark.parametrize("waits", ["progress=lambda *_: time.sleep(1000)", "sections=20"])
def test_the_interpreter_does_not_wait_for_what_never_returns(waits):
    script = f"""
import threading, time
import numpy as np, regionmesh
labels = np.zeros((20, 20, 20), "u1")
labels[5:9] = 1
def endless():
    yield labels[0]
    time.sleep(1000)
run = lambda: regionmesh.reconstruct(labels if "progress" in {waits!r} else endless(), {waits})
threading.Thread(target=run, daemon=True).start()
time.sleep(0.5)
"""
    began = time.monotonic()
    subprocess.run([sys.executable, "-c", script], capture_output=True, timeout=60)
    assert time.monotonic() - began < 20


def test_another_signal_handler_runs_meanwhile(grains):
    seen = []
    before = signal.signal(signal.SIGUSR1, lambda *_: seen.append(True))
    try:

        def sections():
            for n, section in enumerate(grains):
                if n == 3:
                    os.kill(os.getpid(), signal.SIGUSR1)
                yield section

        assert len(regionmesh.reconstruct(sections(), sections=len(grains))) > 0
    finally:
        signal.signal(signal.SIGUSR1, before)
    assert seen


def test_the_interpreter_is_free_meanwhile(large):
    counts = []
    done = threading.Event()

    def count():
        while not done.wait(0.005):
            counts.append(time.monotonic())

    thread = threading.Thread(target=count)
    thread.start()
    regionmesh.reconstruct(large[:20], background=None, reduce=0.5)
    done.set()
    thread.join()
    assert len(counts) > 5


def test_two_reconstructions_at_once(grains, two_boxes):
    alone = [regionmesh.reconstruct(labels, reduce=0.5) for labels in (grains, two_boxes)]
    results = {}

    def run(name, labels):
        for _ in range(5):
            results[name] = regionmesh.reconstruct(labels, reduce=0.5)

    threads = [threading.Thread(target=run, args=item) for item in enumerate((grains, two_boxes))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for name, expected in enumerate(alone):
        np.testing.assert_array_equal(results[name].points, expected.points)


def test_a_reconstruction_in_an_iterator_of_another(two_boxes, grains):
    inner = []

    def sections():
        for section in grains:
            if not inner:
                inner.append(regionmesh.reconstruct(two_boxes))
            yield section

    assert regionmesh.reconstruct(sections(), sections=len(grains)).certified
    assert inner[0].certified


def test_a_thread_of_python_may_run_it(two_boxes):
    results = []
    thread = threading.Thread(target=lambda: results.append(regionmesh.reconstruct(two_boxes).certified))
    thread.start()
    thread.join()
    assert results == [True]


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.parametrize("how", ["good", "raises", "bad option"])
def test_repeated_runs_do_not_leak(grains, how):
    def stop(stage, *_):
        if how == "raises" and stage == "decimate":
            raise RuntimeError("stop")

    def once():
        options = {"reduce": 2} if how == "bad option" else {"reduce": 0.5}
        try:
            mesh = regionmesh.reconstruct(grains, progress=stop, **options)
            mesh.points, mesh.regions
        except (RuntimeError, ValueError):
            assert how != "good"

    for _ in range(10):
        once()
    gc.collect()
    before = resident_bytes()
    for _ in range(30):
        once()
    gc.collect()
    assert resident_bytes() - before < 6 << 20  # a model of this size takes 1 MB


def test_the_array_is_released_after_the_run(two_boxes):
    labels = two_boxes.copy()
    before = sys.getrefcount(labels)
    mesh = regionmesh.reconstruct(labels)
    assert sys.getrefcount(labels) == before
    labels[:] = 0
    assert mesh.certified


def test_the_array_is_released_after_an_error(two_boxes):
    labels = two_boxes.astype(np.float32)
    before = sys.getrefcount(labels)
    with pytest.raises(TypeError):
        regionmesh.reconstruct(labels)
    gc.collect()
    assert sys.getrefcount(labels) == before


def test_the_callable_is_released_after_the_run(two_boxes):
    class Callable:
        def __call__(self, *_):
            pass

    progress = Callable()
    watched = weakref.ref(progress)
    regionmesh.reconstruct(two_boxes, progress=progress)
    del progress
    gc.collect()
    assert watched() is None


def test_arrays_live_longer_than_the_mesh(two_boxes):
    mesh = regionmesh.reconstruct(two_boxes)
    points, faces = mesh.points, mesh.faces
    expected = points.copy(), faces.copy()
    del mesh
    gc.collect()
    regionmesh.reconstruct(two_boxes, smooth="off")
    np.testing.assert_array_equal(points, expected[0])
    np.testing.assert_array_equal(faces, expected[1])


def test_arrays_are_made_once_and_read_only(mesh):
    for name in ("points", "faces", "labels", "node_types"):
        array = getattr(mesh, name)
        assert array is getattr(mesh, name)
        assert not array.flags.writeable and array.flags.c_contiguous
        with pytest.raises(ValueError):
            array[0] = 0
