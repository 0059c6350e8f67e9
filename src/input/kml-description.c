#include "config.h"
#include "input/kml-description.h"
#include "input/xml-feed.h"

#include <string.h>
#include <strings.h>

/* Longer names are sentences. */
enum { LONGEST_NAME = 64 };

/* What stands between words, once tags are gone: SOFT_END for a line end of the text
 * itself, which is a blank where tags say what a line is. */
enum { LINE_END = '\n', CELL_END = '\t', SOFT_END = '\v' };

/* ---- HTML to lines ------------------------------------------------------------ */

static const struct { const char *name; char end; } borders[] = {
    { "td", CELL_END }, { "th", CELL_END }, { "tr", LINE_END }, { "br", LINE_END }, { "p", LINE_END }, { "li", LINE_END },
    { "div", LINE_END }, { "table", LINE_END }, { "ul", LINE_END }, { "dt", LINE_END }, { "dd", CELL_END } };

/* What the tag S[0..N), from behind its '<', is between the words around it: for most
 * nothing, 0.  A cell ends with its own end or that of its row. */
static char border_of(const char *s, size_t n)
{
    bool is_end = n > 0 && *s == '/';
    size_t length = 0;
    s += is_end ? 1 : 0;
    n -= is_end ? 1 : 0;
    while (length < n && !il_xml_is_blank(s[length]) && s[length] != '/' && s[length] != '>')
        length++;
    for (size_t k = 0; k < sizeof borders / sizeof *borders; k++)
        if (strlen(borders[k].name) == length && strncasecmp(borders[k].name, s, length) == 0)
            return borders[k].end == CELL_END && is_end ? 0 : borders[k].end;
    return 0;
}

static bool is_tag(const char *s, size_t n)
{
    return n > 1 && s[0] == '<' && (s[1] == '/' || s[1] == '!' || (s[1] >= 'a' && s[1] <= 'z') || (s[1] >= 'A' && s[1] <= 'Z'));
}

static char text_char(char c)
{
    return c == '\n' ? SOFT_END : c == '\t' || c == '\r' || c == SOFT_END ? ' ' : c;
}

/* The bytes of the tag or character at S[0..N), and in *C what stands for it, 0 for
 * nothing.  *NO_TAGS: no tag ends from here on. */
static size_t next_char(const char *s, size_t n, bool *no_tags, char *c)
{
    static const char space[] = "&nbsp;";
    const char *end = !*no_tags && is_tag(s, n) ? memchr(s, '>', n) : NULL;
    *no_tags |= !end && is_tag(s, n);
    if (end) {
        *c = border_of(s + 1, (size_t)(end - s) - 1);
        return (size_t)(end - s) + 1;
    }
    bool is_space = n >= sizeof space - 1 && memcmp(s, space, sizeof space - 1) == 0;
    *c = is_space ? ' ' : text_char(*s);
    return is_space ? sizeof space - 1 : 1;
}

/* What tags leave of TEXT[0..N), in its place: words, with LINE_END and CELL_END
 * before what begins a line or a cell.  Its length. */
static size_t strip(char *text, size_t n)
{
    size_t m = 0, n_borders = 0;
    bool no_tags = false;
    for (size_t i = 0; i < n;) {
        char c;
        i += next_char(text + i, n - i, &no_tags, &c);
        n_borders += c == LINE_END || c == CELL_END ? 1 : 0;
        if (c)
            text[m++] = c;
    }
    for (size_t i = 0; i < m; i++)
        if (text[i] == SOFT_END)
            text[i] = n_borders > 0 ? ' ' : LINE_END;
    return m;
}

/* ---- lines to attributes ----------------------------------------------------------- */

typedef struct words {
    const char *s;
    size_t n;
} words;

static words trim(const char *s, size_t n)
{
    while (n > 0 && il_xml_is_blank(*s))
        s++, n--;
    while (n > 0 && il_xml_is_blank(s[n - 1]))
        n--;
    return (words){ s, n };
}

/* The cells of LINE that are not empty: up to two in CELL; how many there are. */
static size_t split_cells(words line, words cell[2])
{
    size_t n_cells = 0;
    for (size_t i = 0, end; i < line.n; i = end + 1) {
        const char *tab = memchr(line.s + i, CELL_END, line.n - i);
        end = tab ? (size_t)(tab - line.s) : line.n;
        words w = trim(line.s + i, end - i);
        if (w.n > 0 && n_cells++ < 2)
            cell[n_cells - 1] = w;
    }
    return n_cells;
}

/* Is LINE a name, a colon or equals sign, and a value? */
static bool split_pair(words line, words *name, words *value)
{
    size_t i = 0;
    while (i < line.n && line.s[i] != ':' && line.s[i] != '=')
        i++;
    if (i == line.n)
        return false;
    *name = trim(line.s, i);
    *value = trim(line.s + i + 1, line.n - i - 1);
    return value->n > 0 && value->s[0] != '/'; /* that of an address */
}

static bool is_name(words w)
{
    return w.n > 0 && w.n <= LONGEST_NAME && !(w.s[0] >= '0' && w.s[0] <= '9');
}

/* What LINE says as an attribute; false when it is none. */
static bool read_attribute(words line, words *name, words *value)
{
    words cell[2] = { line, line };
    size_t n_cells = split_cells(line, cell);
    bool is_pair = n_cells == 1 ? split_pair(cell[0], name, value) : n_cells == 2;
    if (is_pair && n_cells == 2) {
        *name = cell[0].s[cell[0].n - 1] == ':' ? trim(cell[0].s, cell[0].n - 1) : cell[0];
        *value = cell[1];
    }
    return is_pair && is_name(*name);
}

il_status il_kml_description_tell(il_map_set *set, char *text, size_t n, il_error *err)
{
    size_t m = strip(text, n), n_others = 0;
    words other = { NULL, 0 }, name, value;
    il_status st = IL_OK;
    for (size_t i = 0, end; i < m && st == IL_OK; i = end + 1) {
        const char *mark = memchr(text + i, LINE_END, m - i);
        end = mark ? (size_t)(mark - text) : m;
        words line = trim(text + i, end - i);
        if (read_attribute(line, &name, &value))
            st = il_map_attribute(set, name.s, name.n, value.s, value.n, err);
        else if (line.n > 0 && n_others++ == 0)
            other = line;
    }
    return st == IL_OK && n_others == 1 ? il_map_place(set, "description", other.s, other.n, err) : st;
}
