"""Runs a batch on two processes: batch_driver.py CLIPS OUT DB prints a line for each record."""

import multiprocessing
import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

import strut

VARIANTS = {"old": "old", "mixed": {"proud": 0.4, "old": -0.2}}


def plan_of(clips: Path, out: Path, db: Path) -> strut.batch.Plan:
    return strut.batch.Plan(clips, out, db, VARIANTS, k=20)


def drive(plan: strut.batch.Plan, on_record=lambda pool: None) -> bool:
    """Does the pending jobs. Returns False if a worker was killed."""
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn"), start, (plan,)) as pool:
        jobs = [pool.submit(perform, job) for job in plan.pending()]
        try:
            for job in as_completed(jobs):
                plan.record([job.result()])
                on_record(pool)
        except BrokenProcessPool:
            return False
    return True


def start(plan: strut.batch.Plan) -> None:
    """Sets a worker's plan."""
    global _plan
    _plan = plan


def perform(job: strut.batch.Job) -> strut.batch.Record:
    return _plan.perform(job)


if __name__ == "__main__":
    drive(plan_of(*map(Path, sys.argv[1:])), lambda _: print("recorded", flush=True))
