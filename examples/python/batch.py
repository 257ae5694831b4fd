"""A batch on two processes, docs/batch.md: runs after ../cli/many_files.sh in the same folder."""

# anchor batch
import concurrent.futures

import strut


def start(plan):
    """Gives a worker its plan."""
    global worker_plan
    worker_plan = plan


def perform(job):
    return worker_plan.perform(job)


if __name__ == "__main__":
    plan = strut.batch.Plan("inputs/", "out/", "demo.strutdb", {"half": {"old": 0.5}}, k=30)
    with concurrent.futures.ProcessPoolExecutor(2, initializer=start, initargs=(plan,)) as workers:
        for record in workers.map(perform, plan.pending()):
            plan.record([record])
            print(record["output"], record["status"])
# end batch
