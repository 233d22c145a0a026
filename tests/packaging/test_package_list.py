"""pyproject.toml names every package of the checkout wherever it names packages, and nothing else."""

from __future__ import annotations

from importlib import metadata

from project import ROOT, SHELVES, packages, pyproject

NOT_SHIPPED = ("tests", "docs")


def test_every_package_on_a_shelf_is_shipped():
    listed = pyproject()["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
    assert sorted(listed) == sorted(folder.as_posix() for folder in packages().values())


def test_every_folder_with_code_on_a_shelf_is_a_package():
    folders = {path.parent.name for shelf in SHELVES[1:] for path in (ROOT / shelf).glob("*/*.py")}
    assert folders <= set(packages())


def test_no_generic_name_is_installed():
    assert all(name == "llm3" or name.startswith("llm3_") for name in packages())


def test_every_plugin_module_is_an_entry_point_and_vice_versa():
    plugins = {f"{name}.plugin" for name, folder in packages().items() if (ROOT / folder / "plugin.py").exists()}
    listed = pyproject()["project"]["entry-points"]["llm3"]
    assert sorted(listed.values()) == sorted(plugins)
    assert all(module == f"llm3_{name}.plugin" for name, module in listed.items())


def test_the_type_checker_and_the_import_linter_see_every_package():
    tools = pyproject()["tool"]
    assert sorted(tools["mypy"]["packages"]) == sorted(packages())
    assert sorted(tools["importlinter"]["root_packages"]) == sorted(packages())


def test_coverage_is_measured_for_the_core_and_the_plugins():
    measured = {name for name, folder in packages().items() if folder.parts[0] in ("llm3", "plugins")}
    assert set(pyproject()["tool"]["coverage"]["run"]["source_pkgs"]) == measured


def test_no_dependency_has_an_upper_bound():
    for line in pyproject()["project"]["dependencies"]:
        requirement = line.partition(";")[0]
        assert ">=" in requirement
        assert "<" not in requirement
        assert "==" not in requirement


def test_the_installed_version_is_the_one_of_the_checkout():
    assert metadata.version("llm3") == pyproject()["project"]["version"]
