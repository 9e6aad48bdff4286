// Of the editor's types only what the package uses.
using System;
using UnityEngine;

namespace UnityEditor
{
    public enum MessageType
    {
        None = 0,
        Info = 1,
        Warning = 2,
        Error = 3,
    }

    public class Editor : ScriptableObject
    {
        public UnityEngine.Object target { get; set; }

        public virtual void OnInspectorGUI()
        {
        }

        public bool DrawDefaultInspector()
        {
            return false;
        }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class CustomEditor : Attribute
    {
        public CustomEditor(Type inspectedType)
        {
        }

        public CustomEditor(Type inspectedType, bool editorForChildClasses)
        {
        }
    }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class MenuItem : Attribute
    {
        public MenuItem(string itemName, bool isValidateFunction, int priority)
        {
        }
    }

    public sealed class MenuCommand
    {
        public UnityEngine.Object context;

        public MenuCommand(UnityEngine.Object context)
        {
            this.context = context;
        }
    }

    public sealed class EditorGUILayout
    {
        public static void Space()
        {
        }

        public static void LabelField(string label, string label2)
        {
        }

        public static void HelpBox(string message, MessageType type)
        {
        }
    }

    public sealed class EditorGUI
    {
        public struct DisabledScope : IDisposable
        {
            public DisabledScope(bool disabled)
            {
            }

            public void Dispose()
            {
            }
        }
    }

    public sealed class EditorApplication
    {
        public delegate void CallbackFunction();

        public static CallbackFunction update;
    }

    public sealed class EditorUtility
    {
        public static void SetDirty(UnityEngine.Object target)
        {
        }
    }

    public sealed class AssetDatabase
    {
        public static void SaveAssets()
        {
        }
    }

    public static class Progress
    {
        [Flags]
        public enum Options
        {
            None = 0,
            Indefinite = 4,
        }

        /// <summary>Bars that are shown. Not part of Unity.</summary>
        public static int Shown;

        public static int Start(string name, string description, Options options)
        {
            return ++Shown;
        }

        public static int Remove(int id)
        {
            return Shown--;
        }
    }

    public sealed class GameObjectUtility
    {
        public static void SetParentAndAlign(GameObject child, GameObject parent)
        {
            child.transform.SetParent(parent == null ? null : parent.transform);
        }
    }

    public sealed class Undo
    {
        public static void RegisterCreatedObjectUndo(UnityEngine.Object objectToUndo, string name)
        {
        }
    }

    public sealed class Selection
    {
        public static UnityEngine.Object activeObject { get; set; }
    }
}
