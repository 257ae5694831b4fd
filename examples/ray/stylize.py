"""Gives many clips one or several styles on a Ray cluster, each exactly once.

    python stylize.py CLIPS OUT --db DB --variants CSV [--actors N] [--threads C]

The same command again does what is not done: after a crash of a worker, of a machine, or of this program.
CLIPS, OUT, DB and CSV are paths that all machines of the cluster can read, OUT one that they can write.
"""

import argparse
import collections
import pathlib
import time
from concurrent.futures import ThreadPoolExecutor

import pyarrow as pa
import ray
import strut

TEXTS = ["job", "key", "input", "input_sha256", "variant", "output", "output_sha256", "status", "code", "message", "version"]
NUMBERS = ["bytes", "frames", "repaired", "time_ms"]
RECORDS = pa.schema([(name, pa.string()) for name in TEXTS] + [(name, pa.int64()) for name in NUMBERS])
"""The columns of records: values may be missing, and columns empty."""


class StyleActor:
    """A process with one open database, whose threads perform jobs."""

    def __init__(self, plan: strut.batch.Plan, threads: int) -> None:
        self.plan = plan
        self.threads = ThreadPoolExecutor(threads)

    def __call__(self, jobs: pa.Table) -> pa.Table:
        records = self.threads.map(self.plan.perform, jobs.to_pylist())
        return pa.Table.from_pylist(list(records), RECORDS)


def records(plan: strut.batch.Plan, jobs: list[strut.batch.Job], actors: int, threads: int, batch_size: int):
    """How the jobs ended, as they end.

    Ray starts an actor whose process or machine is lost again, and hands it its batch again: outputs are replaced by the same bytes.
    A job that ends its process three times has failed.
    """
    styled = ray.data.from_items(jobs).map_batches(
        StyleActor,
        fn_constructor_args=(plan, threads),
        batch_format="pyarrow",
        batch_size=batch_size,
        compute=ray.data.ActorPoolStrategy(size=actors),
        num_cpus=threads,
    )
    yield from styled.iter_rows()


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clips", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--db", type=pathlib.Path, required=True)
    parser.add_argument("--variants", type=pathlib.Path, required=True)
    parser.add_argument("--threads", type=int, default=2, help="of an actor, at most 8; they share a database")
    parser.add_argument("--actors", type=int, help="one for so many cores of the cluster, unless given")
    parser.add_argument("--batch-size", type=int, default=32, help="jobs that are handed to an actor at once")
    return parser.parse_args()


def main() -> None:
    args = arguments()
    # Workers need not have this folder.
    plan = strut.batch.Plan(*(path.absolute() for path in (args.clips, args.out, args.db, args.variants)))
    jobs = plan.pending()
    print(f"{len(jobs)} jobs", flush=True)
    if not jobs:
        return
    ray.init(log_to_driver=False)
    actors = args.actors or max(1, int(ray.cluster_resources()["CPU"]) // args.threads)
    ended: collections.Counter[str] = collections.Counter()
    begin, first = time.monotonic(), None
    for row in records(plan, jobs, actors, args.threads, args.batch_size):
        first = first or time.monotonic()
        plan.record([row])
        ended[row["status"]] += 1
    print(dict(ended), f"in {time.monotonic() - begin:.1f} s, the first after {first - begin:.1f} s", flush=True)


if __name__ == "__main__":
    main()
