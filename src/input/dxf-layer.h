/* dxf-layer.h - the layers of a drawing, and which of them are wanted. */
#ifndef IL_INPUT_DXF_LAYER_H
#define IL_INPUT_DXF_LAYER_H

#include "base/dictionary.h"
#include "input/codepage.h"
#include "input/map-set.h"

/* name: UTF-8.  is_chosen: --layer says so, or nothing.  is_off: switched off or
 * frozen, by the table of layers.  n_taken, n_left: entities. */
typedef struct il_dxf_layer {
    char *name;
    size_t n_name;
    bool is_chosen, is_off;
    size_t n_taken, n_left;
} il_dxf_layer;

/* words: their names as the file has them; layer[i] is the one of number i. */
typedef struct il_dxf_layers {
    il_dictionary words;
    il_dxf_layer *layer;
    size_t n, cap;
    il_codepage page;           /* of names */
    const il_map_options *options;
    bool *matched;              /* of the patterns of --layer */
} il_dxf_layers;

/* Number of the layer "0": what is drawn on it in a block lies on the block's layer. */
enum { IL_DXF_LAYER_0 = 0 };

il_status il_dxf_layers_init(il_dxf_layers *l, const il_map_options *options, il_error *err);
void il_dxf_layers_free(il_dxf_layers *l);

/* The number of the layer S[0..N), new or not, in *INDEX. */
il_status il_dxf_layer_find(il_dxf_layers *l, const char *s, size_t n, long line, uint32_t *index, il_error *err);

/* At the end of the file: tell what was left out, patterns that no layer matches, and
 * layers that are off.  IL_E_INPUT when there is something and none of it is chosen. */
il_status il_dxf_layers_end(il_dxf_layers *l, il_report *report, il_error *err);

#endif
