"""The installed Python module: the page of the documents, the recipes and the notebook."""
import json
import sys

from conftest import SOURCE, blocks

EXAMPLES = SOURCE / "assets" / "examples"


def test_the_page_of_the_documents(installed, tmp_path):
    (tmp_path / "page.py").write_text(blocks("host/api/README.md", "python"))
    installed.python("page.py", cwd=tmp_path)


def test_the_data_set(installed, tmp_path):
    installed.python(EXAMPLES / "dataset.py", "metals", tmp_path, "--views", "3", "--size", "32", "--spp", "2")
    assert len(json.loads((tmp_path / "cameras.json").read_text())) == 3
    assert len(list(tmp_path.glob("view.*.npz"))) == 3


def test_the_regression_test_of_a_driver(installed, tmp_path):
    installed.python("-m", "pytest", "-q", "-p", "no:cacheprovider", EXAMPLES / "test_driver.py", "-k", "equals",
                     cwd=tmp_path)


def test_the_notebook(installed, tmp_path):
    run_it = (
        "import nbformat, nbclient\n"
        f"notebook = nbformat.read({str(EXAMPLES / 'noise.ipynb')!r}, as_version=4)\n"
        "for cell in notebook.cells:\n"
        "    cell.source = cell.source.replace('spp=2048', 'spp=256').replace('64, 128]', ']')\n"
        "nbclient.NotebookClient(notebook, kernel_name='python3').execute()\n"
        "shown = [output for cell in notebook.cells for output in cell.get('outputs', [])]\n"
        "assert sum('image/png' in output.get('data', {}) for output in shown) == 3, shown\n"
    )
    installed.python("-c", run_it, cwd=tmp_path)


def test_no_array_no_numpy(installed, tmp_path):
    check = "import sys, hyalite; assert 'numpy' not in sys.modules; hyalite.Scene().document; hyalite.setting_names()"
    installed.python("-c", check, cwd=tmp_path)


def test_types_are_told(installed):
    assert (installed.modules / "hyalite" / "py.typed").exists()
    assert sys.version_info >= (3, 9)
