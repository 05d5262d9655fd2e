#!/usr/bin/env python3
"""35,000 motions x 20 structures on a Ray cluster of two nodes on this machine, of which one is killed in the middle; against
one process that does the same. cluster.py FOLDER [PARTITIONS]: the folder takes 1 GB. Prints what docs/cluster.md states."""

import pathlib
import sys
import threading
import time

import pyarrow.parquet as pq
import ray
import rockfrag.ray
from ray.cluster_utils import Cluster

STRUCTURES = [{"name": f"s{k}", "p": 1.0 + 0.1 * k, "alpha": 0.12 + 0.008 * k, "eta": 0.92} for k in range(20)]
folder, partitions = pathlib.Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 50
folder.mkdir(exist_ok=True)


def timed(name, call, *arguments, **options):
    start = time.perf_counter()
    result = call(*arguments, **options)
    seconds = time.perf_counter() - start
    print(f"{name:40} {seconds:8.2f} s", flush=True)
    return result, seconds


def on_ray(name, call, *arguments, **options):
    """What a call on the cluster took, and how much of it beside the tasks' own work."""
    made, seconds = timed(name, call, *arguments, **options)
    work = sum(each["seconds"] for each in made)
    nodes = len({each["node"] for each in made})
    print(f"    {len(made)} tasks on {nodes} node(s), {sum(each['rows'] for each in made)} rows, {work:.2f} s in tasks", flush=True)
    return made


def rows(path):
    return pq.read_table(path).replace_schema_metadata(None)


def kill_in_the_middle(cluster, node):
    while len(list(folder.glob("responses/part-*.parquet"))) < partitions // 2:
        time.sleep(0.01)
    cluster.remove_node(node, allow_graceful=False)
    print("    one node killed", flush=True)


scenarios, motions, responses = (folder / name for name in ["scenarios.parquet", "motions", "responses"])
rockfrag.sample_scenarios(samples=1000, out=scenarios)
one = {"threads": 2, "force": True}
timed("one process: motions", rockfrag.synthesize_motions, scenarios, suite="csgm", out=folder / "motions.parquet", **one)
whole = folder / "responses.parquet"
timed("one process: responses", rockfrag.simulate, folder / "motions.parquet", structures=STRUCTURES, out=whole, **one)

cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1, "include_dashboard": False})
node = cluster.add_node(num_cpus=1)
cluster.wait_for_nodes()
ray.init(address=cluster.address, log_to_driver=False)
on_ray("Ray: motions", rockfrag.ray.synthesize, scenarios, motions, partitions=partitions, suite="csgm")
on_ray("Ray: motions again, all done", rockfrag.ray.synthesize, scenarios, motions, partitions=partitions, suite="csgm")
on_ray("Ray: responses", rockfrag.ray.simulate, motions, folder / "undisturbed", structures=STRUCTURES)
killer = threading.Thread(target=kill_in_the_middle, args=(cluster, node))
killer.start()
on_ray("Ray: responses, one node lost", rockfrag.ray.simulate, motions, responses, structures=STRUCTURES)
killer.join()
on_ray("Ray: responses again, all done", rockfrag.ray.simulate, motions, responses, structures=STRUCTURES)
same = rows(responses).equals(rows(whole)) and rows(folder / "undisturbed").equals(rows(whole))
for path in [motions, responses]:
    print(f"{path.name}: {sum(file.stat().st_size for file in path.iterdir()) / 1e6:.0f} MB")
print("the rows are those of one process" if same else "THE ROWS DIFFER")
ray.shutdown()
cluster.shutdown()
sys.exit(not same)
