"""Keep the former name of reports/run_report.py, so that older programs can still import it."""

from gudgeon.results.reports.run_report import RunReport  # noqa: F401
