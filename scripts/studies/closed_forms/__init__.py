"""Closed forms that studies alone compare with."""
