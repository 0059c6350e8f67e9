/* t-csv-samples.c - every sample of formats/csv.txt. */
#include "config.h"
#include "samples.h"

/* Where a table is cut cannot be told. */
static size_t nothing(const char *text)
{
    (void)text;
    return 0;
}

int main(void)
{
    static const samples form = { "csv", ".csv", &il_reader_csv, NULL, NULL, nothing };
    return samples_run(&form, 1, "csv", "3.  Records and cells\n\n");
}
