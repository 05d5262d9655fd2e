"""Every function and class says what it takes and gives, in NumPy's style, with an example that runs."""

import doctest
import importlib
import inspect

import pytest
import rockfrag

MODULES = ["rockfrag", "rockfrag.datasets"]
OPTIONS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE | doctest.IGNORE_EXCEPTION_DETAIL


def public():
    """What the package offers, but for exceptions and what only comes out of functions."""
    results = {"Probability", "DemandCurve", "FailureCurve", "FileInfo", "FragilityCurve", "Response", "Hazard", "Outcomes", "Published"}
    for module in map(importlib.import_module, MODULES):
        for name in module.__all__:
            value = getattr(module, name)
            is_error = inspect.isclass(value) and issubclass(value, Exception)
            if callable(value) and not is_error and name not in results:
                yield pytest.param(value, id=name)


@pytest.mark.parametrize("value", list(public()))
@pytest.mark.filterwarnings("ignore::rockfrag.RockfragWarning")
def test_examples_run(value):
    finder = doctest.DocTestFinder(recurse=inspect.isclass(value))
    module = inspect.getmodule(value)
    tests = [test for test in finder.find(value, module=False, globs={}) if test.examples]
    assert tests, "no example"
    for test in tests:
        runner, told = doctest.DocTestRunner(optionflags=OPTIONS), []
        assert runner.run(test, out=told.append).failed == 0, f"{module}: {''.join(told)}"


@pytest.mark.parametrize("value", [value for value in public() if inspect.isfunction(value.values[0])])
def test_sections(value):
    sections = ["Parameters\n----------", "Returns\n-------", "Examples\n--------"]
    expected = sections if inspect.signature(value).parameters else sections[1:]
    missing = [section for section in expected if section not in inspect.cleandoc(value.__doc__)]
    assert not missing
    for name in inspect.signature(value).parameters:
        assert name in value.__doc__


def test_methods_of_results_say_what_they_do():
    for result in (rockfrag.FragilityCurve, rockfrag.DemandCurve, rockfrag.FailureCurve, rockfrag.Response, rockfrag.Table):
        for name, method in inspect.getmembers(result):
            if not name.startswith("_"):
                assert inspect.getdoc(method), f"{result.__name__}.{name}"
