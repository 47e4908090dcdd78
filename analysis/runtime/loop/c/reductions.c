/* Reduction of the rows of consecutive runs to one number for each run.
 *
 * Sums are formed from the first row to the last, so that a mean does not depend on the number of runs in a call.
 */

enum Reduction { FINAL = 0, MIN = 1, MAX = 2, MEAN = 3, RMS = 4, LAST_OUTSIDE = 5, SETTLED = 6, FIRST_AFTER = 7 };

#define ROUNDING 1e-6 /* fraction of a step, for rounding of times, start + n h */

/* Limits of a reduction; a reduction ignores limits that it does not use. Times in s. */
enum Limit { WINDOW_START = 0, WINDOW_END = 1, BAND_LOW = 2, BAND_HIGH = 3, DELAY = 4 };

/* The rows of a run to reduce, from first to end - 1. */
typedef struct {
    int64_t first;
    int64_t end;
    const double *times;
    const double *values;
    const double *condition;
} Rows;

static double rounding_of(const Rows *rows)
{
    return rows->end - rows->first > 1 ? ROUNDING * (rows->times[rows->first + 1] - rows->times[rows->first]) : 0.0;
}

static bool is_true(double value)
{
    return value != 0.0 && !isnan(value);
}

static double extreme(const Rows *rows, bool smallest)
{
    double extremum = rows->values[rows->first];
    for (int64_t row = rows->first; row < rows->end; row++) {
        const double value = rows->values[row];
        if (isnan(value)) return value;
        if (smallest ? value < extremum : value > extremum) extremum = value;
    }
    return extremum;
}

static double mean(const Rows *rows, bool squared)
{
    double total = 0.0;
    for (int64_t row = rows->first; row < rows->end; row++) {
        const double value = rows->values[row];
        total += squared ? value * value : value;
    }
    total /= (double)(rows->end - rows->first);
    return squared ? sqrt(total) : total;
}

static double last_outside(const Rows *rows, double low, double high)
{
    int64_t row = rows->end - 1;
    while (row >= rows->first && low <= rows->values[row] && rows->values[row] <= high) row--;
    if (row == rows->end - 1) return INFINITY;
    return rows->times[row > rows->first ? row : rows->first];
}

static double settling_time(const Rows *rows, double beginning)
{
    int64_t row = rows->end - 1;
    while (row >= rows->first && is_true(rows->values[row])) row--;
    if (row == rows->end - 1) return INFINITY;
    return row < rows->first ? 0.0 : rows->times[row + 1] - beginning;
}

static double first_after(const Rows *rows, double delay)
{
    int64_t row = rows->first;
    while (row < rows->end && !is_true(rows->condition[row])) row++;
    if (row == rows->end) return NAN;
    const double due = rows->times[row] + delay - rounding_of(rows);
    while (row > rows->first && rows->times[row - 1] >= due) row--;
    while (row < rows->end && rows->times[row] < due) row++;
    return row < rows->end ? rows->values[row] : NAN;
}

static double reduce(int64_t reduction, const double *limits, Rows rows)
{
    if (rows.first == rows.end) return NAN;
    const double rounding = rounding_of(&rows), begin = rows.times[rows.first];
    const double beginning = limits[WINDOW_START] > begin ? limits[WINDOW_START] : begin;
    while (rows.first < rows.end && !(rows.times[rows.first] >= limits[WINDOW_START] - rounding)) rows.first++;
    while (rows.end > rows.first && !(rows.times[rows.end - 1] <= limits[WINDOW_END] + rounding)) rows.end--;
    if (rows.first == rows.end) return NAN;
    switch (reduction) {
    case FINAL: return rows.values[rows.end - 1];
    case MIN: return extreme(&rows, true);
    case MAX: return extreme(&rows, false);
    case MEAN: return mean(&rows, false);
    case RMS: return mean(&rows, true);
    case LAST_OUTSIDE: return last_outside(&rows, limits[BAND_LOW], limits[BAND_HIGH]);
    case SETTLED: return settling_time(&rows, beginning);
    default: return first_after(&rows, limits[DELAY]);
    }
}

/* Compute one number for each run, whose rows end before its entry in `ends`; NaN for a run without rows in the window.
 * The window includes both ends. */
EXPORT void perilune_reduce(
    int64_t reduction,
    const double *limits,
    const double *times,
    const double *values,
    const double *condition,
    const int64_t *ends,
    int64_t runs,
    double *reduced)
{
    int64_t start = 0;
    for (int64_t run = 0; run < runs; run++) {
        reduced[run] = reduce(reduction, limits, (Rows){start, ends[run], times, values, condition});
        start = ends[run];
    }
}
