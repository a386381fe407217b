"""Former name of reports/run_report.py, kept because the reference named it."""

from gudgeon.results.reports.run_report import RunReport  # noqa: F401
