"""Former name of reports/run_report.py, which the reference named."""

from gudgeon.results.reports.run_report import RunReport  # noqa: F401
