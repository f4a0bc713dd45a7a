"""Runs a campaign of trials in a folder: what is finished there is kept, the rest is run, then all is summed up."""

from __future__ import annotations

import functools
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from circlepoint._core import InvalidInput
from circlepoint.campaign import folder as folders
from circlepoint.campaign.cluster import Lost, on_cluster
from circlepoint.campaign.config import Batch, Campaign, load_campaign
from circlepoint.campaign.summary import summarise
from circlepoint.campaign.trials import TrialRunner

if TYPE_CHECKING:
    from collections.abc import Iterator

    import pyarrow as pa

    from circlepoint.document import Document


_most_told = 3


class Watcher(Protocol):
    """What is told of a campaign under way."""

    def begin(self, total: int, finished: int) -> None:
        """Hear how many trials there are, and how many were finished before."""

    def advance(self, trials: int) -> None:
        """Hear of trials done."""

    def tell(self, message: str) -> None:
        """Hear why nothing comes."""


@dataclass(frozen=True)
class Bundle:
    """A campaign as a worker elsewhere gets it: its file's text, and name and text of each file it names."""

    config: str
    files: tuple[tuple[str, str], ...]


def run_campaign(
    campaign: Campaign, out: Path, *, workers: int = 1, scheduler: str | None = None, watcher: Watcher | None = None
) -> Document:
    """Run what is not finished yet, and return the summary of all.

    Parameters
    ----------
    campaign : Campaign
    out : Path
        Its folder: ``campaign.json`` and ``trials/cell-*/batch-*.parquet``.
    workers : int
        Threads of this process; they change the time, never the results.
    scheduler : str, optional
        Address of a Dask scheduler; batches then run on its workers, one thread each.
    watcher : Watcher, optional

    Raises
    ------
    InvalidInput
        When the folder holds another campaign, or another process is writing to it; at the end, when batches took
        down every worker they were given to.
    """
    with folders.only_writer(out):
        description = {
            "config": campaign.document,
            "files": campaign.files,
            "cells": [cell.labels for cell in campaign.cells],
        }
        folders.claim(out, description, campaign.path)
        folders.remove_unfinished(out)
        waiting = [batch for batch in campaign.batches() if not folders.finished(batch_path(out, batch), batch.trials)]
        if watcher is not None:
            watcher.begin(campaign.total, campaign.total - sum(batch.trials for batch in waiting))
        run: Iterator[tuple[Batch, pa.Table | Lost]]
        if scheduler is None or not waiting:
            run = _here(campaign, waiting, workers, watcher)
        else:
            run = _there(campaign, waiting, scheduler, watcher)
        lost = []
        for batch, table in run:
            if isinstance(table, Lost):
                lost.append((batch, table))
                continue
            folders.write_table(batch_path(out, batch), table)
            if watcher is not None and scheduler is not None:
                watcher.advance(batch.trials)
        if lost:
            raise InvalidInput(_told_of(campaign, lost))
        return summarise(campaign, ((batch.cell, batch_path(out, batch)) for batch in campaign.batches()))


def batch_path(out: Path, batch: Batch) -> Path:
    """Return where a batch's table belongs."""
    return out / "trials" / f"cell-{batch.cell:04d}" / f"batch-{batch.index:06d}.parquet"


def _here(
    campaign: Campaign, batches: list[Batch], workers: int, watcher: Watcher | None
) -> Iterator[tuple[Batch, pa.Table]]:
    runner = TrialRunner(campaign)
    for batch in batches:
        told = 0

        def progress(done: int) -> None:
            nonlocal told
            if watcher is not None:
                watcher.advance(done - told)
            told = done

        yield batch, runner.run(batch, workers, progress)


def _there(
    campaign: Campaign, batches: list[Batch], scheduler: str, watcher: Watcher | None
) -> Iterator[tuple[Batch, pa.Table | Lost]]:
    bundle = Bundle(campaign.path.read_text(encoding="utf-8-sig"), tuple(sorted(campaign.files.items())))
    return on_cluster(scheduler, run_bundled, bundle, batches, tell=None if watcher is None else watcher.tell)


def _told_of(campaign: Campaign, lost: list[tuple[Batch, Lost]]) -> str:
    """Return what to tell of batches that took down every worker they were given to."""
    trials = "; ".join(
        f"cell {batch.cell} ({', '.join(campaign.cells[batch.cell].labels.values())}), trials {batch.begin} to "
        f"{batch.end - 1}"
        for batch, _ in lost[:_most_told]
    )
    more = f"; and {len(lost) - _most_told} batches more" if len(lost) > _most_told else ""
    return (
        f"{campaign.path}: {trials}{more}: every worker that was given them was killed, the last at "
        f"{lost[-1][1].worker}, likely for want of memory. All else is finished and kept: give the workers more "
        "memory, or fewer threads, and run it again; or run it without --scheduler on a machine that has enough"
    )


def run_bundled(bundle: Bundle, batch: Batch) -> pa.Table:
    """Run one batch of a campaign that came as a bundle, in one thread."""
    return _runner(bundle).run(batch)


@functools.lru_cache(maxsize=4)
def _runner(bundle: Bundle) -> TrialRunner:
    """Return the runner of a bundle; its files are unpacked while they are read."""
    with tempfile.TemporaryDirectory(prefix="circlepoint-") as name:
        config = Path(name) / "campaign.yaml"
        config.write_text(bundle.config, encoding="utf-8")
        paths = {}
        for index, (file, text) in enumerate(bundle.files):
            paths[file] = Path(name) / str(index) / Path(file).name
            paths[file].parent.mkdir()
            paths[file].write_text(text, encoding="utf-8")
        return TrialRunner(load_campaign(config, paths))
