# SPDX-License-Identifier: Apache-2.0
# What Doxygen reads of a header: the headings of a contract ("Domain    …") become its paragraphs; lines that go on under
# them are not code, formulas (five blanks) stay code, with their ids.
s@^( *)/// (Symbols|Domain|Returns|Accuracy|Errors|Source|Order|Hits)  +@\1///\n\1/// \\par \2\n\1/// @
s@^( *)///  {8,}@\1/// @
s/@eq /equation /g
