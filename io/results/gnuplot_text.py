"""Strings for gnuplot scripts. In double quotes gnuplot runs what stands between backquotes, and a name that begins with < or | is a command."""
import os


def quoted(text):
    return "'" + "".join(c if c >= " " else " " for c in text).replace("'", "''") + "'"


def quoted_path(path):
    return quoted(os.path.abspath(path))
