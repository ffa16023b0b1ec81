"""The report's figures. Each module draws one: `lacking(scene)` says why it cannot, `draw` fills given axes,
`figure` makes the page."""
