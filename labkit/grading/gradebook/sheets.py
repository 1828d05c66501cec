"""Tables as CSV: read as any spreadsheet or platform saves them, written so that all can read them.

UTF-8 and UTF-16 are read, with commas, semicolons or tabs. UTF-8 is written, with a byte order
mark: without one, Excel shows no umlauts.
"""
import codecs
import csv
import io
import re
from typing import NamedTuple

from ... import places


class Sheet(NamedTuple):
    """A table, and how its file was written."""

    header: list
    rows: list
    lines: list             # of each row, its last line in the file
    delimiter: str = ","
    newline: str = "\n"
    has_bom: bool = False   # whether the file begins with a byte order mark


def read(path) -> Sheet:
    """A table from a file, without its empty rows, short rows filled up.

    ValueError: it is no text, or no table.
    """
    text, has_bom = decoded(path)
    try:
        delimiter = max(",;\t", key=lambda each: len(next(parsed(text, each), ())))
        table = parsed(text, delimiter)
        rows = [(row, table.line_num) for row in table if any(map(str.strip, row))]
    except csv.Error as error:
        raise ValueError(f"{path} is no CSV file ({error}): export it again as CSV") from None
    if not rows:
        raise ValueError(f"{path} is empty: it should have a row of titles, and rows below it")
    (header, _), *below = rows
    newline = "\r\n" if "\r\n" in text else "\n"
    return Sheet([title.strip() for title in header],
                 [row + [""] * (len(header) - len(row)) for row, _ in below],
                 [line for _, line in below], delimiter, newline, has_bom)


def by_columns(path, columns):
    """Yield (where it is, its cells in these columns) of each row. ValueError: one is not there."""
    sheet = read(path)
    if missing := [name for name in columns if name not in sheet.header]:
        raise ValueError(f"{path} has no column {missing[0]}: its first line should be "
                         f"{','.join(columns)}")
    for row, line in zip(sheet.rows, sheet.lines, strict=True):
        yield f"{path}, line {line}", [row[sheet.header.index(name)].strip() for name in columns]


def decoded(path):
    """-> (text, whether it began with a byte order mark)."""
    content = places.read_whole(path)
    is_utf_16 = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    try:
        return (content.decode("utf-16" if is_utf_16 else "utf-8-sig"),
                is_utf_16 or content.startswith(codecs.BOM_UTF8))
    except UnicodeDecodeError as error:
        raise ValueError(f"{path} is not UTF-8 text (byte {error.start}): export it again, or save "
                         "it as \"CSV UTF-8\"") from None


def parsed(text, delimiter):
    return csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)


def written(rows, delimiter=",", newline="\n", has_bom=True) -> bytes:
    """Rows of cells -> the bytes of a file."""
    text = io.StringIO(newline="")
    csv.writer(text, delimiter=delimiter, lineterminator=newline).writerows(rows)
    return text.getvalue().encode("utf-8-sig" if has_bom else "utf-8")


def plain(cell):
    """A cell that no spreadsheet takes for a formula, whoever wrote it."""
    begins = isinstance(cell, str) and cell.startswith(("=", "+", "-", "@", "\t", "\r"))
    return f"'{cell}" if begins else cell


def in_one_cell(sentences) -> str:
    """Sentences, with semicolons between them and nowhere else."""
    return "; ".join(sentence.replace(";", ",") for sentence in sentences)


def number(text) -> float | None:
    """'15', '15.25' or '15,25' -> the number. None: it is none from 0 on."""
    return float(text.replace(",", ".")) if re.fullmatch(r"\d*[.,]?\d+", text) else None


def number_text(points) -> str:
    """15.0 -> '15', 15.25 -> '15.25', None -> '': points as they are written."""
    return "" if points is None else f"{points:.2f}".rstrip("0").rstrip(".")
