"""The same work on an existing Dask cluster: tasks out, results back, workers lost on the way or not."""

from __future__ import annotations

import logging
from contextlib import contextmanager
from dataclasses import dataclass
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from circlepoint._core import InvalidInput, __version__

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

Item = TypeVar("Item")
Result = TypeVar("Result")
_tasks_per_thread = 2
_connect_seconds = 20
_patience_seconds = 15


@dataclass(frozen=True)
class Lost:
    """In place of a result: all workers that the task was given to were lost, also when it was the only one.

    Attributes
    ----------
    worker : str
        Address of the last one, or what it was.
    """

    worker: str


def on_cluster(
    address: str,
    work: Callable[[Any, Item], Result],
    common: Any,
    items: Iterable[Item],
    *,
    tell: Callable[[str], None] | None = None,
) -> Iterator[tuple[Item, Result | Lost]]:
    """Yield each item with its result, as they come.

    A few tasks a thread are under way at any time, whatever the number of items. Dask runs a task again whose worker is
    lost, and gives it up after some (``distributed.scheduler.allowed-failures``). It may be innocent, for it is blamed
    for what its neighbours do; so it runs once more, alone, when all others are done. Every task carries all it needs.

    Parameters
    ----------
    address : str
        Of the scheduler, such as ``tcp://10.0.0.1:8786``.
    work : callable
        ``work(common, item)``; a function of this package, which the workers must have installed in the same version.
    common : object
        Sent with every task; small.
    items : iterable
    tell : callable, optional
        Called with what a user should know while nothing comes: that there are no workers.

    Raises
    ------
    InvalidInput
        Without Dask, without the scheduler, and with workers that lack this package or have another version.
    """
    try:
        from distributed import CancelledError, Client  # noqa: PLC0415  (an extra)
    except ImportError as error:
        raise InvalidInput(
            "--scheduler needs Dask: pip install 'distributed>=2024.5' (the extra circlepoint[dask])"
        ) from error
    try:
        client = Client(address, timeout=_connect_seconds, set_as_default=False)
    except (OSError, ValueError) as error:
        raise InvalidInput(
            f"--scheduler {address}: no Dask scheduler answers there ({error}); start it, or mend the address"
        ) from error
    try:
        with _quiet(), client:
            tasks: _Tasks[Item, Result] = _Tasks(
                client, address, lambda item: (_checked, __version__, work, common, item), tell
            )
            suspects = []
            for item, result in tasks.run(items, None):
                if isinstance(result, Lost):
                    suspects.append(item)
                else:
                    yield item, result
            yield from tasks.run(suspects, 1)
    except ModuleNotFoundError as error:
        raise InvalidInput(
            f"--scheduler {address}: the workers have no module {error.name!r}; install circlepoint {__version__} there"
        ) from error
    except (OSError, CancelledError) as error:
        raise InvalidInput(
            f"--scheduler {address}: the connection was lost ({error}). What is finished is kept: run it again"
        ) from error


class _Tasks(Generic[Item, Result]):
    """Keeps a number of tasks under way."""

    def __init__(
        self, client: Any, address: str, call: Callable[[Item], tuple[Any, ...]], tell: Callable[[str], None] | None
    ) -> None:
        self._client, self._address, self._call, self._tell = client, address, call, tell
        self._done: SimpleQueue[Any] = SimpleQueue()

    def run(self, items: Iterable[Item], at_once: int | None) -> Iterator[tuple[Item, Result | Lost]]:
        """Yield items with results; so many tasks at once, or as many as keep every thread busy."""
        from distributed import KilledWorker  # noqa: PLC0415

        waiting = iter(items)
        under_way: dict[str, tuple[Item, Any]] = {}
        more = True
        while True:
            wanted = at_once or _tasks_per_thread * max(self._threads(), 1)
            while more and len(under_way) < wanted:
                item = next(waiting, None)
                if item is None:
                    more = False
                    break
                future = self._client.submit(*self._call(item), pure=False)
                under_way[str(future.key)] = item, future
                future.add_done_callback(self._done.put)
            if not under_way:
                return
            future = self._next()
            item, _ = under_way.pop(str(future.key))
            result: Result | Lost
            try:
                result = future.result()
            except KilledWorker as error:
                result = Lost(error.last_worker.address)
            except OSError as error:
                if future.status != "error":
                    raise
                raise InvalidInput(
                    f"--scheduler {self._address}: a worker failed: {error}. What is finished is kept: mend the worker "
                    "and run it again"
                ) from error
            yield item, result

    def _next(self) -> Any:
        """Wait for a task's end; say so once when there is nobody to bring it about."""
        told = False
        while True:
            try:
                return self._done.get(timeout=_patience_seconds)
            except Empty:
                if not told and self._tell is not None and not self._threads():
                    self._tell(f"--scheduler {self._address}: it has no workers; waiting for some")
                    told = True

    def _threads(self) -> int:
        return sum(self._client.nthreads().values())


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep Dask from logging on the way what is told here in the end: workers and connections that are lost."""
    handlers = logging.getLogger("distributed").handlers
    levels = [handler.level for handler in handlers]
    for handler in handlers:
        handler.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for handler, level in zip(handlers, levels, strict=True):
            handler.setLevel(level)


def _checked(version: str, work: Callable[[Any, Item], Result], common: Any, item: Item) -> Result:
    if version != __version__:
        raise InvalidInput(
            f"a worker has circlepoint {__version__}, this is {version}; install the same version everywhere"
        )
    return work(common, item)
