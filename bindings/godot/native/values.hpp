/* Godot's values as those of C++. */
#ifndef PBMPM_GODOT_VALUES_HPP
#define PBMPM_GODOT_VALUES_HPP

#include "gdnative.hpp"

#include <pbmpm/pbmpm.hpp>

#include <string>
#include <vector>

namespace godot_values {

/* To Godot. */

inline gdnative::variant nothing()
{
    gdnative::variant it;
    gdnative::variant_new_nil(&it);
    return it;
}
inline gdnative::variant from(bool value)
{
    gdnative::variant it;
    gdnative::variant_new_bool(&it, value);
    return it;
}
inline gdnative::variant from(std::int64_t value)
{
    gdnative::variant it;
    gdnative::variant_new_int(&it, value);
    return it;
}
inline gdnative::variant from(double value)
{
    gdnative::variant it;
    gdnative::variant_new_real(&it, value);
    return it;
}
inline gdnative::variant from(const pbmpm::vector3 &value)
{
    gdnative::vector3 vector;
    std::memcpy(vector.of, value.data(), sizeof vector.of);
    gdnative::variant it;
    gdnative::variant_new_vector3(&it, &vector);
    return it;
}
inline gdnative::variant from(const char *value)
{
    gdnative::string text;
    gdnative::string_new(&text);
    gdnative::string_parse_utf8(&text, value);
    gdnative::variant it;
    gdnative::variant_new_string(&it, &text);
    gdnative::string_destroy(&text);
    return it;
}
/* Identifiers of the library as whole numbers; 0 stands for none. */
template <class Id> std::int64_t number_of(Id id) { return static_cast<std::int64_t>(std::uint64_t{id.generation} << 32 | id.index); }
template <class Id> Id id_of(std::int64_t number)
{
    const auto bits = static_cast<std::uint64_t>(number);
    return {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32)};
}

/* From Godot. */

inline pbmpm::vector3 vector_of(const gdnative::variant *value)
{
    const gdnative::vector3 bytes = gdnative::variant_as_vector3(value);
    pbmpm::vector3 it;
    std::memcpy(it.data(), bytes.of, sizeof bytes.of);
    return it;
}
inline pbmpm::quaternion quaternion_of(const gdnative::variant *value)
{
    const gdnative::quat bytes = gdnative::variant_as_quat(value);
    pbmpm::quaternion it;
    std::memcpy(it.data(), bytes.of, sizeof bytes.of);
    return it;
}
inline std::string text_of(const gdnative::variant *value)
{
    gdnative::string text = gdnative::variant_as_string(value);
    gdnative::utf8 bytes = gdnative::string_utf8(&text);
    std::string it = gdnative::utf8_text(&bytes);
    gdnative::utf8_destroy(&bytes);
    gdnative::string_destroy(&text);
    return it;
}
inline std::vector<float> reals_of(const gdnative::variant *value)
{
    gdnative::pool_reals pool = gdnative::variant_as_pool_reals(value);
    gdnative::access *access = gdnative::pool_reals_read(&pool);
    const float *first = gdnative::pool_reals_read_at(access);
    std::vector<float> it(first, first + gdnative::pool_reals_size(&pool));
    gdnative::pool_reals_were_read(access);
    gdnative::pool_reals_destroy(&pool);
    return it;
}
/* Three for each vector. */
inline std::vector<float> vectors_of(const gdnative::variant *value)
{
    gdnative::pool_vectors pool = gdnative::variant_as_pool_vectors(value);
    gdnative::access *access = gdnative::pool_vectors_read(&pool);
    const float *first = gdnative::pool_vectors_read_at(access);
    std::vector<float> it(first, first + 3 * gdnative::pool_vectors_size(&pool));
    gdnative::pool_vectors_were_read(access);
    gdnative::pool_vectors_destroy(&pool);
    return it;
}

/* The fields of a dictionary that a script gives. Fields that are not there leave their targets as they are. Reading notes which are known, so
 * that a mistyped one is found; and the first one of a wrong type. */
class fields {
public:
    explicit fields(const gdnative::variant *value) : it_(gdnative::variant_as_dictionary(value)) {}
    ~fields() { gdnative::dictionary_destroy(&it_); }
    fields(const fields &) = delete;
    fields &operator=(const fields &) = delete;

    void read(const char *name, float &target)
    {
        take(name, "a number", is_number, [&](const auto *value) { target = static_cast<float>(gdnative::variant_as_real(value)); });
    }
    void read(const char *name, double &target)
    {
        take(name, "a number", is_number, [&](const auto *value) { target = gdnative::variant_as_real(value); });
    }
    template <class Whole, class = std::enable_if_t<std::is_integral_v<Whole> || std::is_enum_v<Whole>>> void read(const char *name, Whole &target)
    {
        take(name, "a whole number", is_whole, [&](const auto *value) { target = static_cast<Whole>(gdnative::variant_as_int(value)); });
    }
    void read(const char *name, float (&target)[3])
    {
        take(name, "a Vector3", is<gdnative::VECTOR3>, [&](const auto *value) {
            const pbmpm::vector3 vector = vector_of(value);
            std::memcpy(target, vector.data(), sizeof target);
        });
    }
    void read(const char *name, float (&target)[4])
    {
        take(name, "a Quat", is<gdnative::QUAT>, [&](const auto *value) {
            const pbmpm::quaternion turn = quaternion_of(value);
            std::memcpy(target, turn.data(), sizeof target);
        });
    }
    template <class Id> void read_id(const char *name, Id &target)
    {
        take(name, "an identifier", is_whole, [&](const auto *value) { target = id_of<Id>(gdnative::variant_as_int(value)); });
    }
    /* One of several words, which are 0, 1, ... */
    template <class Enumeration> void read_word(const char *name, std::initializer_list<const char *> words, Enumeration &target)
    {
        take(name, "a word", is<gdnative::STRING>, [&](const auto *value) {
            const std::string word = text_of(value);
            int number = 0;
            for (const char *known : words) {
                if (word == known) {
                    target = static_cast<Enumeration>(number);
                    return;
                }
                number++;
            }
            complain(std::string(name) + " can not be '" + word + "'");
        });
    }
    /* What is wrong, or an empty text. To be asked when all has been read. */
    const std::string &complaint()
    {
        if (complaint_.empty() && found_ < gdnative::dictionary_size(&it_)) complaint_ = "there is a field that is none of: " + known_;
        return complaint_;
    }

private:
    static bool is_number(int type) { return type == gdnative::REAL || type == gdnative::INT; }
    static bool is_whole(int type) { return type == gdnative::INT || type == gdnative::BOOL; }
    template <gdnative::type wanted> static bool is(int type) { return type == wanted; }
    void complain(const std::string &what)
    {
        if (complaint_.empty()) complaint_ = what;
    }
    template <class Action> void take(const char *name, const char *wanted, bool (*fits)(int), Action action)
    {
        known_ += known_.empty() ? name : std::string(", ") + name;
        gdnative::variant key = from(name);
        if (gdnative::dictionary_has(&it_, &key)) {
            found_++;
            gdnative::variant value = gdnative::dictionary_get(&it_, &key);
            if (fits(gdnative::variant_type(&value)))
                action(&value);
            else
                complain(std::string(name) + " is not " + wanted);
            gdnative::variant_destroy(&value);
        }
        gdnative::variant_destroy(&key);
    }

    gdnative::dictionary it_;
    int found_ = 0;
    std::string known_, complaint_;
};

/* A dictionary for a script. */
class answer {
public:
    answer() { gdnative::dictionary_new(&it_); }
    ~answer() { gdnative::dictionary_destroy(&it_); }
    answer(const answer &) = delete;
    answer &operator=(const answer &) = delete;
    template <class Value> void set(const char *name, Value value)
    {
        gdnative::variant key = from(name), held = from(value);
        gdnative::dictionary_set(&it_, &key, &held);
        gdnative::variant_destroy(&key);
        gdnative::variant_destroy(&held);
    }
    gdnative::variant value() const
    {
        gdnative::variant it;
        gdnative::variant_new_dictionary(&it, &it_);
        return it;
    }

private:
    gdnative::dictionary it_;
};

} // namespace godot_values
#endif
