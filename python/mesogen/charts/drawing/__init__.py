"""The charts of studies. Each module draws one, deterministically: equal points give equal bytes."""
