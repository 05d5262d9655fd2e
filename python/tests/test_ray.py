"""Partitions on a Ray cluster of this machine."""

import pytest

ray = pytest.importorskip("ray")

import rockfrag
import rockfrag.ray


def test_partitions_are_the_rows_of_one_machine(tmp_path):
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    try:
        scenarios = rockfrag.sample_scenarios(samples=3, seed=7, out=tmp_path / "scenarios.parquet")
        files = rockfrag.ray.synthesize(scenarios.path, tmp_path / "motions", partitions=3, suite="pulse")
        assert [file.name for file in files] == [f"part-{index:05}.parquet" for index in range(3)]
        rockfrag.ray.simulate(tmp_path / "motions", tmp_path / "responses", structures="paper")
        before = [file.stat().st_mtime_ns for file in sorted((tmp_path / "responses").iterdir())]
        rockfrag.ray.simulate(tmp_path / "motions", tmp_path / "responses", structures="paper")
        assert before == [file.stat().st_mtime_ns for file in sorted((tmp_path / "responses").iterdir())]
        with pytest.raises(ValueError, match="15.*alpha"):
            rockfrag.ray.simulate(tmp_path / "motions", tmp_path / "no", partitions=3, p=1, alpha=15, eta=0.9)
    finally:
        ray.shutdown()
    alone = rockfrag.simulate(rockfrag.synthesize_motions(scenarios, suite="pulse"), structures="paper")
    assert rockfrag.fit_pro(tmp_path / "responses").to_polars().equals(rockfrag.fit_pro(alone).to_polars())
