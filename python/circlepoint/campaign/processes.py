"""The same work in processes of this machine, killed on the way or not."""

from __future__ import annotations

import multiprocessing
import signal
import threading
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import resource_tracker
from typing import TYPE_CHECKING, TypeVar

from circlepoint.campaign.cluster import Lost

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterable, Iterator
    from concurrent.futures import Future

Item = TypeVar("Item")
Result = TypeVar("Result")
_HERE = "a process of this machine"


def in_processes(
    work: Callable[[Item], Result], items: Iterable[Item], workers: int
) -> Generator[tuple[Item, Result | Lost]]:
    """Yield each item with its result, as they come.

    An item that was in hand when a process was killed may be innocent: it runs once more, alone, when all others are
    done. An interruption from the keyboard is this process's affair; the others are then killed.

    Parameters
    ----------
    work : callable
        ``work(item)``; a function of a module.
    items : iterable
    workers : int
        Processes at a time.
    """
    waiting = list(items)
    suspects: list[Item] = []  # in hand when a process was killed
    while waiting:
        running: dict[Future[Result], Item] = {}
        with _pool(workers) as pool:
            try:
                while waiting or running:
                    while waiting and len(running) < workers:
                        running[_submit(pool, work, waiting[0])] = waiting[0]
                        del waiting[0]
                    for future in wait(running, return_when=FIRST_COMPLETED).done:
                        result = future.result()
                        yield running.pop(future), result
            except BrokenProcessPool:
                suspects += running.values()
    for item in suspects:
        with _pool(1) as pool:
            try:
                yield item, _submit(pool, work, item).result()
            except BrokenProcessPool:
                yield item, Lost(_HERE)


@contextmanager
def _pool(workers: int) -> Iterator[ProcessPoolExecutor]:
    """Give processes, which are not waited for when this one is interrupted or has given up."""
    others = set(multiprocessing.active_children())
    with ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn")) as pool:
        try:
            yield pool
        except BaseException:
            for process in set(multiprocessing.active_children()) - others:
                process.kill()
            raise


def _submit(pool: ProcessPoolExecutor, work: Callable[[Item], Result], item: Item) -> Future[Result]:
    """Submit an item; the process this may begin leaves an interruption from the keyboard to this one."""
    resource_tracker.ensure_running()  # whose own start would let the signal through
    with _interrupted_later():
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # the process inherits it
        try:
            return pool.submit(work, item)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)


@contextmanager
def _interrupted_later() -> Iterator[None]:
    """Put an interruption from the keyboard off to the end: a process half begun would be lost sight of.

    Blocking the signal in this thread is not enough: another thread takes it, and this one hears of it all the same.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    interruptions: list[int] = []
    handler = signal.signal(signal.SIGINT, lambda number, _: interruptions.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler if handler is None else handler)
        if interruptions:
            signal.raise_signal(signal.SIGINT)
