"""Builds the wheel by maturin, with the stub of the stages, which the built module itself describes."""

import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import maturin
from maturin import *  # noqa: F403

STUB = Path(__file__).parent / "python/rockfrag/_stages.pyi"
# Without what the package needs when it is installed.
SCRIPT = """
import sys, types
sys.modules["rockfrag"] = package = types.ModuleType("rockfrag")
package.__path__ = ["rockfrag"]
from rockfrag._bridge import stub
print(stub(), end="")
"""


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = maturin.build_wheel(wheel_directory, config_settings, metadata_directory)
    with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(Path(wheel_directory, name)) as wheel:
        wheel.extractall(folder)
        stub = subprocess.run(
            [sys.executable, "-c", SCRIPT], cwd=folder, check=True, stdout=subprocess.PIPE
        ).stdout
    if STUB.exists() and STUB.read_bytes() == stub:
        return name
    STUB.write_bytes(stub)
    return maturin.build_wheel(wheel_directory, config_settings, metadata_directory)
