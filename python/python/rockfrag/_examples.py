"""An example of each stage, which the tests run: the second half of its docstring."""

_MOTIONS = """
>>> import rockfrag
>>> scenarios = rockfrag.sample_scenarios(mw="6.5:7.5:0.5", re="5,10", samples=20)
>>> motions = rockfrag.synthesize_motions(scenarios, suite="csgm", dt=0.01)
"""
_RESPONSES = (
    _MOTIONS
    + """\
>>> equipment = rockfrag.Structure(p=2.5, alpha=0.20, eta=0.92, name="equipment")
>>> responses = rockfrag.simulate(motions, structures=equipment)
"""
)
_FITS = (
    _RESPONSES
    + """\
>>> pex, pro = rockfrag.fit_pex(responses, transition=1.3), rockfrag.fit_pro(responses)
"""
)

EXAMPLES = {
    "sample-scenarios": """
>>> import rockfrag
>>> scenarios = rockfrag.sample_scenarios(mw=[6.5, 7.0], re=10, samples=5, seed=1)
>>> scenarios.shape
(10, 9)
>>> scenarios["mw"]
array([6.5, 6.5, 6.5, 6.5, 6.5, 7. , 7. , 7. , 7. , 7. ])
""",
    "synthesize-motions": """
>>> import rockfrag
>>> scenarios = rockfrag.sample_scenarios(mw=6.5, re=10, samples=5)
>>> motions = rockfrag.synthesize_motions(scenarios, suite=["pulse", "csgm"])
>>> len(motions), motions["suite"][:2].tolist()
(10, ['pulse', 'csgm'])
>>> motions["acceleration_m_s2"][0].shape == motions["acceleration_m_s2"][1].shape
True
""",
    "import-motions": """
>>> import numpy as np, pathlib, rockfrag, tempfile
>>> folder = tempfile.TemporaryDirectory()
>>> file = pathlib.Path(folder.name, "mine.txt")
>>> np.savetxt(file, 0.4 * np.sin(np.linspace(0.0, 60.0, 2001)) * np.hanning(2001))
>>> motions = rockfrag.import_motions(file, dt=0.01, unit="g")
>>> motions["pga_m_s2"].round(2)
array([3.92])
>>> folder.cleanup()
""",
    "simulate": _MOTIONS
    + """\
>>> block = rockfrag.Structure.block(0.5, 2.0, name="block")
>>> responses = rockfrag.simulate(motions, structures=block)
>>> len(responses), sum(responses["outcome"] == "overturning").item()
(120, 23)
>>> rockfrag.simulate(motions)
Traceback (most recent call last):
rockfrag.errors.OptionError: no structure; ...
""",
    "ida": """
>>> import rockfrag
>>> scenarios = rockfrag.sample_scenarios(mw=7.0, re=5, samples=3)
>>> motions = rockfrag.synthesize_motions(scenarios, suite="pulse", dt=0.01)
>>> ida = rockfrag.ida(motions, structures=rockfrag.Structure.block(0.5, 2.0))
>>> len(ida)
3
""",
    "fit-pex": _RESPONSES
    + """\
>>> pex = rockfrag.fit_pex(responses, transition=1.3)
>>> plane = pex.to_polars().filter(model="plane")
>>> round(plane["b1"].item(), 1), round(plane["r2"].item(), 2)
(2.1, 0.37)
""",
    "fit-pro": _RESPONSES
    + """\
>>> pro = rockfrag.fit_pro(responses, link="logit")
>>> dict(zip(pro["im_x"].tolist(), pro["status"].tolist()))["im5"]
'ok'
""",
    "universality": _MOTIONS
    + """\
>>> structures = [rockfrag.Structure(p=p, alpha=0.2, eta=0.92, name=f"p{p}") for p in (2.0, 2.5)]
>>> responses = rockfrag.simulate(motions, structures=structures)
>>> verdicts = rockfrag.universality(responses, reference="p2.5")
>>> verdicts["verdict"].tolist()
['bends', 'holds', 'fails', 'holds']
""",
    "rank-ims": _RESPONSES
    + """\
>>> ranking = rockfrag.rank_ims(responses)
>>> ranking.columns[:4]
['suite', 'structure', 'target', 'measures']
""",
    "compare-paper": """
>>> import rockfrag
>>> motions = rockfrag.synthesize_motions(rockfrag.sample_scenarios(), threads=2)
>>> responses = rockfrag.simulate(motions, structures="paper")
>>> pex, pro = rockfrag.fit_pex(responses, transition=1.3), rockfrag.fit_pro(responses)
>>> compared = rockfrag.compare_paper(pex, pro, responses)
>>> row = compared.to_polars().filter(quantity="high_b1", suite="csgm", structure="electrical-equipment")
>>> row["published"].item(), round(row["ours"].item(), 3)
(2.954, 3.088)
""",
    "validate": _FITS
    + """\
>>> others = rockfrag.sample_scenarios(mw="6.5:7.5:0.5", re="5,10", samples=5, seed=1)
>>> unseen = rockfrag.simulate(rockfrag.synthesize_motions(others, suite="csgm", dt=0.01, seed=1), structures=equipment)
>>> validation = rockfrag.validate(unseen, pex, pro, model="univariate", measure="im5")
>>> validation.columns[:4]
['suite', 'structure', 'fits_suite', 'event']
""",
    "evaluate": """
Of any structure, without fits of one's own: a block at one intensity (``pga`` in g, ``pgv`` in m/s), at each of a table, or at a site.

>>> import rockfrag
>>> answer = rockfrag.evaluate(width=0.5, height=2.0, pga=0.5, pgv=0.6)
>>> dict(zip(answer["quantity"].tolist(), answer["value"].round(3).tolist()))["p_ro"]
0.258
>>> import polars as pl
>>> intensities = pl.DataFrame({"pga_m_s2": [3.0, 5.0, 8.0], "pgv_m_s": [0.3, 0.6, 1.0]})
>>> rockfrag.evaluate(intensities=intensities, width=0.5, height=2.0)["p_ro"].round(3)
array([0.   , 0.264, 0.836])
>>> site = rockfrag.evaluate(width=0.5, height=2.0, hazard=rockfrag.datasets.load_hazard(), ratio=0.4)
>>> site["state"].tolist()
['LS1', 'LS2', 'LS3']
""",
    "export": _FITS
    + """\
>>> import pathlib, tempfile
>>> folder = tempfile.TemporaryDirectory()
>>> file = pathlib.Path(folder.name, "fragility.xml")
>>> made = rockfrag.export(pex, pro, model="univariate", measure="im5", structures=equipment, to="openquake", ratio=0.4, out=file)
>>> folder.cleanup()
""",
    "report": _RESPONSES
    + """\
>>> import pathlib, tempfile
>>> folder = tempfile.TemporaryDirectory()
>>> responses.to_polars().write_parquet(pathlib.Path(folder.name, "responses.parquet"))
>>> rockfrag.report(folder.name, out=pathlib.Path(folder.name, "report.html")).name
'report.html'
>>> folder.cleanup()
""",
}
