"""What `mesogen chart`, `mesogen sweep` and `mesogen study` share: they run cases, and keep and read the results.

Every run is one process, `mesogen run CASE --set KEY=VALUE ... --output FOLDER`.

    table_reader, overrides          read TOML files and the keys of the case that a run changes
    check                            ask mesogen about all cases before the first run starts
    execution, progress, command     one run as a process; progress on the terminal; options and exit codes
    ledger, program, markdown        runs.csv; the version and defaults that a run depends on; tables
    sweep_file, points, conflicts    a sweep: one case over a grid of parameters and seeds
    records, attempt, runner         the state of a sweep's runs, one run that can be resumed, several runs at a time
    finished, statistics             the finished runs of a sweep, and means over time with their errors

Nothing here imports `charts`, `sweep` or `study`.
"""
