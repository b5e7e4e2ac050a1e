"""Models run in febio4 with a sanitized plugin, and again cut back, restarted, with two threads, by every solver."""
