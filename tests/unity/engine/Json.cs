using System;
using System.Collections.Generic;
using System.Globalization;
using System.Reflection;
using System.Text;

namespace UnityEngine
{
    /// <summary>Fields of objects from text, as Unity's does: what the text does not give keeps its value, what has no field is passed over.</summary>
    public static class JsonUtility
    {
        public static T FromJson<T>(string json)
        {
            var place = 0;
            return (T)Fill(typeof(T), Value(json, ref place));
        }

        static object Fill(Type kind, object value)
        {
            var members = value as Dictionary<string, object>;
            if (members == null) return value is double ? Convert.ChangeType(value, kind, CultureInfo.InvariantCulture) : value;
            var made = Activator.CreateInstance(kind);
            foreach (var field in kind.GetFields(BindingFlags.Instance | BindingFlags.Public))
                if (members.ContainsKey(field.Name) && members[field.Name] != null)
                    field.SetValue(made, Fill(field.FieldType, members[field.Name]));
            return made;
        }

        static object Value(string text, ref int place)
        {
            Skip(text, ref place);
            switch (text[place])
            {
                case '{': return Members(text, ref place);
                case '[': return Items(text, ref place);
                case '"': return Word(text, ref place);
                default: return Plain(text, ref place);
            }
        }

        static object Members(string text, ref int place)
        {
            var members = new Dictionary<string, object>();
            place++;
            while (!Ends(text, ref place, '}'))
            {
                var name = Word(text, ref place);
                Skip(text, ref place);
                place++; // the colon
                members[name] = Value(text, ref place);
            }
            return members;
        }

        static object Items(string text, ref int place)
        {
            var items = new List<object>();
            place++;
            while (!Ends(text, ref place, ']')) items.Add(Value(text, ref place));
            return items;
        }

        static bool Ends(string text, ref int place, char end)
        {
            Skip(text, ref place);
            if (text[place] == ',') place++;
            Skip(text, ref place);
            if (text[place] != end) return false;
            place++;
            return true;
        }

        static string Word(string text, ref int place)
        {
            Skip(text, ref place);
            var word = new StringBuilder();
            for (place++; text[place] != '"'; place++) word.Append(text[place] == '\\' ? text[++place] : text[place]);
            place++;
            return word.ToString();
        }

        static object Plain(string text, ref int place)
        {
            var begin = place;
            while (place < text.Length && ",]} \t\r\n".IndexOf(text[place]) < 0) place++;
            var word = text.Substring(begin, place - begin);
            if (word == "null") return null;
            if (word == "true" || word == "false") return word == "true";
            return double.Parse(word, CultureInfo.InvariantCulture);
        }

        static void Skip(string text, ref int place)
        {
            while (char.IsWhiteSpace(text[place])) place++;
        }
    }
}
