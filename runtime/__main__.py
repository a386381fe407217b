"""Run the command line by `python -m gudgeon`, where the script `gudgeon` is not on the PATH."""

from gudgeon.entry import main

main()
