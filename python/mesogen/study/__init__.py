"""Studies: many runs of one scene, charted. `mesogen chart STUDY.toml`, or python3 -m mesogen.study STUDY.toml.

A *scene* is a folder with case.toml and answer.toml, which says what is known about it (see scene.py). A *study* names a
scene, variants of its case, resolutions and repeats (see accuracy_study.py). Every run is a process of its own; what
came out of it is kept in runs.csv, so that a study that was broken off goes on where it was.
"""
