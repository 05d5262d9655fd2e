"""Partitions on a cluster of Ray: the rows are those of one machine, whatever becomes of a node."""

import subprocess
import sys
import threading
import time

import pyarrow.parquet as pq
import pytest
import rockfrag
from conftest import MOTIONS, STRUCTURES

ray = pytest.importorskip("ray")
cluster_utils = pytest.importorskip("ray.cluster_utils")


# What a node does without, so that little has to start.
NODE = {"num_cpus": 1, "object_store_memory": 80 * 2**20}
HEAD = NODE | {"include_dashboard": False, "include_log_monitor": False, "no_monitor": True}
# The programs that Ray starts beside each node.
AGENTS = "import ray.dashboard.agent, ray._private.runtime_env.agent.main"


@pytest.fixture(scope="module")
def cluster():
    import rockfrag.ray  # noqa: F401

    # Ray ends a node whose agents are not up within 15 s (ray-project/ray issue 65983): loaded once, they are at hand.
    subprocess.run([sys.executable, "-c", AGENTS], check=True)
    cluster = cluster_utils.Cluster(initialize_head=True, head_node_args=HEAD)
    ray.init(address=cluster.address, log_to_driver=False)
    yield cluster
    ray.shutdown()
    cluster.shutdown()


def rows(folder):
    return pq.read_table(folder).replace_schema_metadata(None)


def expected(file):
    return pq.read_table(file).replace_schema_metadata(None)


def test_partitions_are_the_whole_and_done_ones_are_skipped(cluster, out, tmp_path):
    made = rockfrag.ray.synthesize(out / "scenarios.parquet", tmp_path / "motions", partitions=5, **MOTIONS)
    assert [(result["index"], result["of"]) for result in made] == [(index, 5) for index in range(5)]
    assert sum(result["rows"] for result in made) == 80
    assert rows(tmp_path / "motions").equals(expected(out / "motions.parquet"))
    rockfrag.ray.simulate(tmp_path / "motions", tmp_path / "responses", structures=STRUCTURES)
    assert rows(tmp_path / "responses").equals(expected(out / "responses.parquet"))
    files = sorted((tmp_path / "responses").iterdir())
    files[3].unlink()
    before = [file.stat().st_mtime_ns for file in files if file != files[3]]
    rockfrag.ray.simulate(tmp_path / "motions", tmp_path / "responses", structures=STRUCTURES)
    assert [file.stat().st_mtime_ns for file in files if file != files[3]] == before
    assert rows(tmp_path / "responses").equals(expected(out / "responses.parquet"))


def test_a_store_of_objects(cluster, out, tmp_path):
    import fsspec

    store = fsspec.filesystem("dir", path=str(tmp_path), fs=fsspec.filesystem("file"))
    (tmp_path / "scenarios.parquet").write_bytes((out / "scenarios.parquet").read_bytes())
    for _ in range(2):
        rockfrag.ray.synthesize("scenarios.parquet", "motions", partitions=2, filesystem=store, **MOTIONS)
        rockfrag.ray.simulate("motions", "responses", filesystem=store, structures=STRUCTURES)
        assert rows(tmp_path / "responses").equals(expected(out / "responses.parquet"))
        assert len(list((tmp_path / "responses").iterdir())) == 2
    with pytest.raises(Exception, match="empty"):
        rockfrag.ray.simulate("empty", "responses", filesystem=store, structures=STRUCTURES)


def test_a_lost_node_changes_nothing(cluster, out, tmp_path):
    node = cluster.add_node(**NODE)
    cluster.wait_for_nodes()
    rockfrag.ray.synthesize(out / "scenarios.parquet", tmp_path / "motions", partitions=20, **MOTIONS)

    def kill():
        while len(list(tmp_path.glob("responses/part-*.parquet"))) < 4:
            time.sleep(0.01)
        cluster.remove_node(node, allow_graceful=False)

    killer = threading.Thread(target=kill)
    killer.start()
    made = rockfrag.ray.simulate(tmp_path / "motions", tmp_path / "responses", structures=STRUCTURES)
    killer.join()
    assert len(made) == 20
    assert not node.any_processes_alive()
    assert rows(tmp_path / "responses").equals(expected(out / "responses.parquet"))
