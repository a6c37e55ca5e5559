"""The command `asperity` of the package."""

import json
import subprocess
import sys
from pathlib import Path

SCRIPT = Path(sys.executable).with_name("asperity")


def run(*words, cwd=None):
    return subprocess.run([SCRIPT, *words], capture_output=True, text=True, cwd=cwd, timeout=300)


def test_help_lists_the_commands():
    said = run("--help")
    assert said.returncode == 0 and said.stderr == ""
    for command in ("render", "bake", "tables", "check-ndf"):
        assert f"\n  {command} " in said.stdout


def test_errors_are_one_line():
    said = run("render", "--zom", "2")
    assert said.returncode == 2
    assert said.stderr == "error: unexpected argument '--zom' found; tip: a similar argument exists: '--zoom'\n"
    said = run("check-ndf", "--ndf", "velvet")
    assert said.returncode == 1 and said.stderr.count("\n") == 1


def test_bake_resumes_by_the_same_program(tmp_path):
    words = ["bake", "--size", "128", "--tile", "64", "--octaves", "2", "--out", str(tmp_path)]
    assert run(*words, "--tiles", "1-3").returncode == 0
    said = run(*words)
    assert said.returncode == 0 and "75 % reused" in said.stdout, said.stdout
    assert (tmp_path / "height.png").is_file()


def test_jobs_call_the_script(tmp_path):
    job = tmp_path / "job.json"
    assert run("bake", "--size", "64", "--job", str(job), cwd=tmp_path).returncode == 0
    template = json.loads(job.read_text())
    assert template["parameterDefinitions"][0]["default"] == str(SCRIPT)
    assert template["steps"][0]["script"]["actions"]["onRun"]["args"][:3] == ["bake", "--size", "64"]


def test_module_runs_the_command(tmp_path):
    job = tmp_path / "job.json"
    words = ["-m", "asperity", "bake", "--size", "64", "--job", str(job)]
    assert subprocess.run([sys.executable, *words], cwd=tmp_path, timeout=60).returncode == 0
    assert json.loads(job.read_text())["parameterDefinitions"][0]["default"] == str(SCRIPT)
