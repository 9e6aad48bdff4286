using System;
using System.Collections.Generic;

namespace UnityEngine
{
    [Flags]
    public enum HideFlags
    {
        None = 0,
        HideAndDontSave = 61,
    }

    public class Object
    {
        internal bool Destroyed;

        public virtual string name { get; set; } = "";
        public HideFlags hideFlags { get; set; }

        public static void Destroy(Object one)
        {
            DestroyImmediate(one);
        }

        public static void DestroyImmediate(Object one)
        {
            if (one is GameObject) ((GameObject)one).End();
            else if (one is Component) ((Component)one).End();
            one.Destroyed = true;
        }

        public static T[] FindObjectsOfType<T>() where T : Object
        {
            var found = new List<T>();
            foreach (var body in GameObject.All)
                if (body.activeInHierarchy)
                    foreach (var part in body.Components)
                        if (part is T)
                            found.Add((T)(Object)part);
            return found.ToArray();
        }

        public static bool operator ==(Object a, Object b)
        {
            return ReferenceEquals(a, b) || IsNothing(a) && IsNothing(b);
        }

        public static bool operator !=(Object a, Object b)
        {
            return !(a == b);
        }

        public override bool Equals(object other)
        {
            return ReferenceEquals(this, other);
        }

        public override int GetHashCode()
        {
            return System.Runtime.CompilerServices.RuntimeHelpers.GetHashCode(this);
        }

        static bool IsNothing(Object one)
        {
            return ReferenceEquals(one, null) || one.Destroyed;
        }
    }

    public class ScriptableObject : Object
    {
        public static T CreateInstance<T>() where T : ScriptableObject
        {
            return Activator.CreateInstance<T>();
        }
    }

    public class TextAsset : Object
    {
        public TextAsset(string text)
        {
            this.text = text;
        }

        public string text { get; }
    }

    public sealed class GameObject : Object
    {
        internal static readonly List<GameObject> All = new List<GameObject>();
        internal readonly List<Component> Components = new List<Component>();

        public GameObject(string name = "")
        {
            this.name = name;
            transform = new Transform { gameObject = this };
            Components.Add(transform);
            All.Add(this);
        }

        public Transform transform { get; }
        public int layer { get; set; }
        public bool activeSelf { get; private set; } = true;
        public bool activeInHierarchy => activeSelf && (transform.parent == null || transform.parent.gameObject.activeInHierarchy);

        public T AddComponent<T>() where T : Component
        {
            return (T)Add(typeof(T));
        }

        public T GetComponent<T>()
        {
            foreach (var one in Components)
                if (one is T)
                    return (T)(object)one;
            return default(T);
        }

        public T GetComponentInParent<T>()
        {
            for (var place = transform; place != null; place = place.parent)
            {
                var found = place.gameObject.GetComponent<T>();
                if (found != null) return found;
            }
            return default(T);
        }

        public void SetActive(bool active)
        {
            if (activeSelf == active) return;
            activeSelf = active;
            Player.Awaken();
        }

        Component Add(Type kind)
        {
            foreach (RequireComponent needed in kind.GetCustomAttributes(typeof(RequireComponent), true))
                foreach (var other in needed.Types)
                    if (other != null && !Components.Exists(other.IsInstanceOfType))
                        Add(other);
            var made = (Component)Activator.CreateInstance(kind);
            made.gameObject = this;
            Components.Add(made);
            Player.Enter(made as MonoBehaviour);
            return made;
        }

        internal void End()
        {
            foreach (var one in Components.ToArray()) one.End();
            foreach (var child in transform.Children.ToArray()) DestroyImmediate(child.gameObject);
            All.Remove(this);
        }
    }

    public class Component : Object
    {
        public GameObject gameObject { get; internal set; }
        public Transform transform => gameObject.transform;
        public override string name => gameObject.name;

        public T GetComponent<T>()
        {
            return gameObject.GetComponent<T>();
        }

        public T GetComponentInParent<T>()
        {
            return gameObject.GetComponentInParent<T>();
        }

        internal virtual void End()
        {
            gameObject.Components.Remove(this);
            Destroyed = true;
        }
    }

    public sealed class Transform : Component
    {
        internal readonly List<Transform> Children = new List<Transform>();

        public Transform parent { get; private set; }
        public Vector3 localScale { get; set; } = Vector3.one;
        public Vector3 position { get; set; }
        public Quaternion rotation { get; set; } = Quaternion.identity;
        public Vector3 lossyScale => parent == null ? localScale : Vector3.Scale(localScale, parent.lossyScale);
        public Vector3 forward => rotation * Vector3.forward;

        public void SetParent(Transform other)
        {
            if (parent != null) parent.Children.Remove(this);
            parent = other;
            if (other != null) other.Children.Add(this);
        }
    }

    public class Behaviour : Component
    {
        bool wanted = true;

        public bool enabled
        {
            get { return wanted; }
            set
            {
                if (wanted == value) return;
                wanted = value;
                Player.Awaken();
            }
        }

        public bool isActiveAndEnabled => wanted && !Destroyed && gameObject.activeInHierarchy;
    }

    public class MonoBehaviour : Behaviour
    {
        internal Messages Messages;
        public bool useGUILayout { get; set; } = true;

        internal override void End()
        {
            Player.Leave(this);
            base.End();
        }
    }

    public static class Resources
    {
        /// <summary>Whatever is asked for is there; the layout of the package is looked at elsewhere.</summary>
        public static T Load<T>(string path) where T : Object
        {
            return typeof(T) == typeof(Shader) ? (T)(Object)new Shader { name = path } : null;
        }
    }

    // Attributes

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class DefaultExecutionOrder : Attribute
    {
        public DefaultExecutionOrder(int order)
        {
            this.order = order;
        }

        public int order { get; }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class DisallowMultipleComponent : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class AddComponentMenu : Attribute
    {
        public AddComponentMenu(string menuName)
        {
        }
    }

    [AttributeUsage(AttributeTargets.Class, AllowMultiple = true)]
    public sealed class RequireComponent : Attribute
    {
        internal readonly Type[] Types;

        public RequireComponent(Type first, Type second)
        {
            Types = new[] { first, second };
        }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class CreateAssetMenuAttribute : Attribute
    {
        public string menuName { get; set; }
        public string fileName { get; set; }
    }

    public abstract class PropertyAttribute : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class TooltipAttribute : PropertyAttribute
    {
        public TooltipAttribute(string tooltip)
        {
        }
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class HeaderAttribute : PropertyAttribute
    {
        public HeaderAttribute(string header)
        {
        }
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class SerializeField : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class HideInInspector : Attribute
    {
    }

    public enum RuntimeInitializeLoadType
    {
        AfterSceneLoad = 0,
        SubsystemRegistration = 4,
    }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class RuntimeInitializeOnLoadMethodAttribute : Attribute
    {
        public RuntimeInitializeOnLoadMethodAttribute(RuntimeInitializeLoadType loadType)
        {
        }
    }
}

namespace AOT
{
    [AttributeUsage(AttributeTargets.Method)]
    public sealed class MonoPInvokeCallbackAttribute : Attribute
    {
        public MonoPInvokeCallbackAttribute(Type type)
        {
        }
    }
}
