"""The page of devices that are left out counts the scenes that are better and worse without each."""

from __future__ import annotations

from dataclasses import replace

import pytest

from studies.ablation import page
from studies.ablation.ablated_runs import Ablated

WHOLE = Ablated("scene", "joint", "nothing", True, 100, 1, 40, 1000, 2.0, "kept_matrix 3")
WITHOUT = replace(WHOLE, without="kept_matrix", acted="")


@pytest.mark.parametrize(
    ("change", "better", "worse"),
    [
        ({}, False, False),
        ({"iterations": 99}, False, False),
        ({"iterations": 98}, True, False),
        ({"iterations": 103}, False, True),
        ({"iterations": 200, "retries": 0}, True, False),
        ({"iterations": 50, "retries": 2}, False, True),
        ({"iterations": 50, "ended": False}, False, True),
    ],
)
def test_retries_count_before_iterations(change, better, worse):
    (pair,) = page.pairs([WHOLE, replace(WITHOUT, **change)])
    assert (pair.is_better, pair.is_worse) == (better, worse)


def test_a_device_that_did_not_act_is_in_no_comparison():
    assert page.pairs([WHOLE, replace(WITHOUT, without="row_operations"), replace(WITHOUT, without="any")]) == []


def test_a_ratio_is_that_of_the_run_without_the_device_over_that_with_all():
    (pair,) = page.pairs([WHOLE, replace(WITHOUT, time=3.0)])
    assert pair.ratio("time") == 1.5


def test_runs_without_any_device_are_compared_where_some_acted():
    idle = replace(WHOLE, scene="idle", acted="")
    rows = [WHOLE, replace(WITHOUT, without="any"), idle, replace(idle, without="any")]
    assert [pair.whole.scene for pair in page.pairs_without_any(rows)] == ["scene"]
