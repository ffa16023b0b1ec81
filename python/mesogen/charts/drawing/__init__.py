"""The charts of studies, one module for each. Equal points give files with equal bytes."""
