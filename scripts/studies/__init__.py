"""What developers run beside the commands for users: studies over many runs, and the pages made from their results.

It imports the package `harness`, which pip installs; nothing there imports it.
"""
