/* The part of Godot 3's native interface (GDNative core 1.0, nativescript 1.0) that the plugin uses. Godot's own headers are not needed.
 *
 * Godot hands over tables of functions. Their order has been the same since 3.0, and new ones come in tables of their own. Each function stands here with
 * its place in the table. Values are bytes to us: structures of bytes are passed to functions in other registers than structures of floats, so they stay bytes. */
#ifndef PBMPM_GODOT_GDNATIVE_HPP
#define PBMPM_GODOT_GDNATIVE_HPP

#include <cstdint>
#include <cstring>

namespace gdnative {

template <int size> struct bytes {
    alignas(size % 8 == 0 ? 8 : 4) std::uint8_t of[size];
};
struct variant : bytes<24> {};
struct string : bytes<8> {};
struct utf8 : bytes<8> {};
struct dictionary : bytes<8> {};
struct array : bytes<8> {};
struct pool_reals : bytes<8> {};
struct pool_vectors : bytes<8> {};
struct vector3 : bytes<12> {};
struct quat : bytes<16> {};
struct access;
struct object;

enum type { NIL = 0, BOOL = 1, INT = 2, REAL = 3, STRING = 4, VECTOR3 = 7, QUAT = 10, DICTIONARY = 18, POOL_REALS = 22, POOL_VECTORS = 25 };

struct table {
    unsigned type, major, minor;
    const table *next;
};
using function = void (*)();
struct core_table : table {
    unsigned extension_count;
    const table *const *extensions;
    function functions[1];
};
struct nativescript_table : table {
    function functions[1];
};

/* What Godot tells the library when it loads it. */
struct init_options {
    bool in_editor;
    std::uint64_t core_hash, editor_hash, no_hash;
    void (*report_version_mismatch)(const object *, const char *, unsigned long long, unsigned long long);
    void (*report_loading_error)(const object *library, const char *what);
    object *library;
    const core_table *core;
    const string *path;
};

struct create_function {
    void *(*create)(object *instance, void *data);
    void *data;
    void (*release)(void *data);
};
struct destroy_function {
    void (*destroy)(object *instance, void *data, void *user);
    void *data;
    void (*release)(void *data);
};
struct method_function {
    variant (*call)(object *instance, void *data, void *user, int count, variant **arguments);
    void *data;
    void (*release)(void *data);
};
struct method_attributes {
    int remote;
};

inline const core_table *core;
inline const nativescript_table *nativescript;

/* Whether the library runs with this Godot; keeps its tables. */
inline bool begin(const init_options &options)
{
    constexpr unsigned nativescripts = 1;
    core = options.core;
    for (unsigned i = 0; i < core->extension_count; i++)
        if (core->extensions[i]->type == nativescripts) nativescript = static_cast<const nativescript_table *>(core->extensions[i]);
    return core->major == 1 && nativescript && nativescript->major == 1;
}

#define PBMPM_GODOT_FUNCTION(table, place, result, name, ...) \
    template <class... Arguments> result name(Arguments... arguments) { return reinterpret_cast<result (*)(__VA_ARGS__)>(table->functions[place])(arguments...); }

PBMPM_GODOT_FUNCTION(core, 198, access *, pool_reals_write, pool_reals *)
PBMPM_GODOT_FUNCTION(core, 304, float *, pool_reals_write_at, const access *)
PBMPM_GODOT_FUNCTION(core, 306, void, pool_reals_written, access *)
PBMPM_GODOT_FUNCTION(core, 187, void, pool_reals_new, pool_reals *)
PBMPM_GODOT_FUNCTION(core, 196, void, pool_reals_resize, pool_reals *, int)
PBMPM_GODOT_FUNCTION(core, 201, int, pool_reals_size, const pool_reals *)
PBMPM_GODOT_FUNCTION(core, 197, access *, pool_reals_read, const pool_reals *)
PBMPM_GODOT_FUNCTION(core, 276, const float *, pool_reals_read_at, const access *)
PBMPM_GODOT_FUNCTION(core, 278, void, pool_reals_were_read, access *)
PBMPM_GODOT_FUNCTION(core, 202, void, pool_reals_destroy, pool_reals *)
PBMPM_GODOT_FUNCTION(core, 249, int, pool_vectors_size, const pool_vectors *)
PBMPM_GODOT_FUNCTION(core, 245, access *, pool_vectors_read, const pool_vectors *)
PBMPM_GODOT_FUNCTION(core, 288, const float *, pool_vectors_read_at, const access *)
PBMPM_GODOT_FUNCTION(core, 290, void, pool_vectors_were_read, access *)
PBMPM_GODOT_FUNCTION(core, 250, void, pool_vectors_destroy, pool_vectors *)
PBMPM_GODOT_FUNCTION(core, 362, void, dictionary_new, dictionary *)
PBMPM_GODOT_FUNCTION(core, 364, void, dictionary_destroy, dictionary *)
PBMPM_GODOT_FUNCTION(core, 365, int, dictionary_size, const dictionary *)
PBMPM_GODOT_FUNCTION(core, 368, bool, dictionary_has, const dictionary *, const variant *)
PBMPM_GODOT_FUNCTION(core, 374, variant, dictionary_get, const dictionary *, const variant *)
PBMPM_GODOT_FUNCTION(core, 375, void, dictionary_set, dictionary *, const variant *, const variant *)
PBMPM_GODOT_FUNCTION(core, 507, int, variant_type, const variant *)
PBMPM_GODOT_FUNCTION(core, 509, void, variant_new_nil, variant *)
PBMPM_GODOT_FUNCTION(core, 510, void, variant_new_bool, variant *, bool)
PBMPM_GODOT_FUNCTION(core, 512, void, variant_new_int, variant *, std::int64_t)
PBMPM_GODOT_FUNCTION(core, 513, void, variant_new_real, variant *, double)
PBMPM_GODOT_FUNCTION(core, 514, void, variant_new_string, variant *, const string *)
PBMPM_GODOT_FUNCTION(core, 517, void, variant_new_vector3, variant *, const vector3 *)
PBMPM_GODOT_FUNCTION(core, 528, void, variant_new_dictionary, variant *, const dictionary *)
PBMPM_GODOT_FUNCTION(core, 532, void, variant_new_pool_reals, variant *, const pool_reals *)
PBMPM_GODOT_FUNCTION(core, 539, std::int64_t, variant_as_int, const variant *)
PBMPM_GODOT_FUNCTION(core, 540, double, variant_as_real, const variant *)
PBMPM_GODOT_FUNCTION(core, 541, string, variant_as_string, const variant *)
PBMPM_GODOT_FUNCTION(core, 544, vector3, variant_as_vector3, const variant *)
PBMPM_GODOT_FUNCTION(core, 547, quat, variant_as_quat, const variant *)
PBMPM_GODOT_FUNCTION(core, 555, dictionary, variant_as_dictionary, const variant *)
PBMPM_GODOT_FUNCTION(core, 559, pool_reals, variant_as_pool_reals, const variant *)
PBMPM_GODOT_FUNCTION(core, 562, pool_vectors, variant_as_pool_vectors, const variant *)
PBMPM_GODOT_FUNCTION(core, 570, void, variant_destroy, variant *)
PBMPM_GODOT_FUNCTION(core, 572, const char *, utf8_text, const utf8 *)
PBMPM_GODOT_FUNCTION(core, 573, void, utf8_destroy, utf8 *)
PBMPM_GODOT_FUNCTION(core, 574, void, string_new, string *)
PBMPM_GODOT_FUNCTION(core, 678, utf8, string_utf8, const string *)
PBMPM_GODOT_FUNCTION(core, 679, bool, string_parse_utf8, string *, const char *)
PBMPM_GODOT_FUNCTION(core, 721, void, string_destroy, string *)
PBMPM_GODOT_FUNCTION(core, 741, void, print_error, const char *, const char *, const char *, int)
PBMPM_GODOT_FUNCTION(nativescript, 0, void, register_class, void *, const char *, const char *, create_function, destroy_function)
PBMPM_GODOT_FUNCTION(nativescript, 2, void, register_method, void *, const char *, const char *, method_attributes, method_function)

#undef PBMPM_GODOT_FUNCTION

} // namespace gdnative
#endif
