"""The figures of a report, one module for each: lacking(scene) says why the figure cannot be drawn, None if it can;
draw(axes, scene) fills given axes; figure(scene) makes the page."""
