"""The same work on an existing Dask cluster: tasks out, results back, workers lost on the way or not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from circlepoint._core import InvalidInput, __version__

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

Item = TypeVar("Item")
Result = TypeVar("Result")
_tasks_per_thread = 2
_connect_seconds = 20


def on_cluster(
    address: str, work: Callable[[Any, Item], Result], common: Any, items: Iterable[Item]
) -> Iterator[tuple[Item, Result]]:
    """Yield each item with its result, as they come.

    A few tasks a thread are under way at any time, whatever the number of items. Dask runs a task again whose worker is
    lost; every task carries all it needs.

    Parameters
    ----------
    address : str
        Of the scheduler, such as ``tcp://10.0.0.1:8786``.
    work : callable
        ``work(common, item)``; a function of this package, which the workers must have installed in the same version.
    common : object
        Sent with every task; small.
    items : iterable

    Raises
    ------
    InvalidInput
        Without Dask, without the scheduler, with workers that lack this package or have another version, and when a
        task took down one worker after the other.
    """
    try:
        from distributed import CancelledError, Client, KilledWorker, as_completed  # noqa: PLC0415  (an extra)
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
    waiting = iter(items)
    items_of: dict[str, Item] = {}

    def submit() -> list[Any]:
        """Fill up to the number of tasks that keeps every thread busy."""
        wanted = _tasks_per_thread * max(sum(client.nthreads().values()), 1)
        futures = []
        while len(items_of) < wanted and (item := next(waiting, None)) is not None:
            future = client.submit(_checked, __version__, work, common, item, pure=False)
            items_of[str(future.key)] = item
            futures.append(future)
        return futures

    try:
        with client:
            running = as_completed(submit(), loop=client.loop)
            for future in running:
                result: Result = future.result()
                yield items_of.pop(str(future.key)), result
                running.update(submit())
    except KilledWorker as error:
        raise InvalidInput(
            f"--scheduler {address}: a task's workers were lost again and again ({error}); give the workers more "
            "memory, or the campaign a smaller batch. What is finished is kept: run it again"
        ) from error
    except ModuleNotFoundError as error:
        raise InvalidInput(
            f"--scheduler {address}: the workers have no module {error.name!r}; install circlepoint {__version__} there"
        ) from error
    except (OSError, CancelledError) as error:
        raise InvalidInput(
            f"--scheduler {address}: the connection was lost ({error}). What is finished is kept: run it again"
        ) from error


def _checked(version: str, work: Callable[[Any, Item], Result], common: Any, item: Item) -> Result:
    if version != __version__:
        raise InvalidInput(
            f"a worker has circlepoint {__version__}, this is {version}; install the same version everywhere"
        )
    return work(common, item)
