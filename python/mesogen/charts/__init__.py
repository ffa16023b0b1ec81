"""Studies of one scene as charts: `mesogen chart STUDY.toml`, or python3 -m mesogen.charts STUDY.toml.

A *scene* is a folder with case.toml and answer.toml, the known result (see scene.py). A *study* names a scene, variants
of its case, and resolutions (accuracy_study.py) or a parameter to search (stability_study.py). Every run is one
process; its numbers are kept in runs.csv, so that an interrupted study goes on where it was.
"""
