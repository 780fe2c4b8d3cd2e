-- The store, version 18: a copy that was made without its log is known as one.

-- One row: does the log that the header of the file announces hold rows that are not in the file?
-- It is set by the first commit of a log, and unset by its last.
CREATE TABLE log (
  is_open INTEGER NOT NULL CHECK (is_open IN (0, 1))
) STRICT;
INSERT INTO log VALUES (0);
