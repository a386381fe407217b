"""Contains one file for each joint type."""
