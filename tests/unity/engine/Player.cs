using System;
using System.Collections.Generic;
using System.Reflection;

namespace UnityEngine
{
    /// <summary>What a script hears, made into delegates once, so that frames make no garbage.</summary>
    public sealed class Messages
    {
        static readonly string[] Names = { "Awake", "OnEnable", "Start", "FixedUpdate", "Update", "LateUpdate", "OnGUI", "OnDisable", "OnDestroy" };
        const BindingFlags All = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly;

        readonly Action[] calls = new Action[Names.Length];
        internal readonly int Order;
        internal bool IsAwake, IsOn, IsStarted;

        internal Messages(MonoBehaviour script)
        {
            foreach (DefaultExecutionOrder order in script.GetType().GetCustomAttributes(typeof(DefaultExecutionOrder), true)) Order = order.order;
            for (var i = 0; i < Names.Length; i++) calls[i] = Find(script, Names[i]);
        }

        /// <summary>That of the most derived class, private ones too, as Unity takes it. One with parameters is an error there.</summary>
        static Action Find(MonoBehaviour script, string name)
        {
            for (var kind = script.GetType(); kind != typeof(MonoBehaviour); kind = kind.BaseType)
                foreach (var method in kind.GetMethods(All))
                {
                    if (method.Name != name) continue;
                    if (method.GetParameters().Length > 0) throw new InvalidOperationException(kind + ": " + name + "() can not take parameters");
                    return (Action)Delegate.CreateDelegate(typeof(Action), script, method);
                }
            return null;
        }

        internal void Send(Message message)
        {
            var call = calls[(int)message];
            if (call != null) call();
        }
    }

    internal enum Message
    {
        Awake,
        OnEnable,
        Start,
        FixedUpdate,
        Update,
        LateUpdate,
        OnGUI,
        OnDisable,
        OnDestroy,
    }

    /// <summary>A stand-in for the engine's loop: the order of messages is that of Unity's manual. Not part of Unity.</summary>
    public static class Player
    {
        static readonly List<MonoBehaviour> Scripts = new List<MonoBehaviour>();
        static double unfixed;

        public static bool IsPlaying { get; private set; }

        /// <summary>Begins to play. All scripts of the scene wake by their order.</summary>
        /// <param name="assembly">Whose statics are reset as without a domain reload.</param>
        public static void Play(params Assembly[] assembly)
        {
            foreach (var one in assembly) Initialize(one);
            IsPlaying = true;
            unfixed = 0;
            Time.Begin();
            Awaken();
        }

        /// <summary>Ends it: all scripts are disabled and destroyed, as the scene is loaded anew.</summary>
        public static void Stop()
        {
            foreach (var body in GameObject.All.ToArray()) if (!body.Destroyed) Object.DestroyImmediate(body);
            IsPlaying = false;
        }

        public static void Frame(float seconds)
        {
            Time.deltaTime = seconds;
            Time.time += seconds;
            Time.frameCount++;
            Starts();
            Fixed(seconds);
            Send(Message.Update);
            Send(Message.LateUpdate);
            Send(Message.OnGUI);
            Camera.Render();
        }

        static void Fixed(float seconds)
        {
            unfixed += Math.Min(seconds, Time.maximumDeltaTime);
            while (unfixed >= Time.fixedDeltaTime)
            {
                unfixed -= Time.fixedDeltaTime;
                Time.deltaTime = Time.fixedDeltaTime;
                Time.fixedTime += Time.fixedDeltaTime;
                Send(Message.FixedUpdate);
                Physics.Simulate(Time.fixedDeltaTime);
            }
            Time.deltaTime = seconds;
        }

        internal static void Enter(MonoBehaviour script)
        {
            if (ReferenceEquals(script, null)) return;
            script.Messages = new Messages(script);
            var place = Scripts.Count;
            while (place > 0 && Scripts[place - 1].Messages.Order > script.Messages.Order) place--;
            Scripts.Insert(place, script);
            Awaken();
        }

        internal static void Leave(MonoBehaviour script)
        {
            var heard = script.Messages;
            if (heard.IsOn) heard.Send(Message.OnDisable);
            if (heard.IsAwake) heard.Send(Message.OnDestroy);
            heard.IsOn = heard.IsAwake = false;
            Scripts.Remove(script);
        }

        /// <summary>Sends what follows from scripts that are active now, or no longer.</summary>
        internal static void Awaken()
        {
            if (!IsPlaying) return;
            for (var i = 0; i < Scripts.Count; i++)
            {
                var script = Scripts[i];
                var heard = script.Messages;
                var on = script.isActiveAndEnabled;
                if (script.gameObject.activeInHierarchy && !heard.IsAwake)
                {
                    heard.IsAwake = true;
                    heard.Send(Message.Awake);
                }
                if (on == heard.IsOn) continue;
                heard.IsOn = on;
                heard.Send(on ? Message.OnEnable : Message.OnDisable);
            }
        }

        static void Starts()
        {
            for (var i = 0; i < Scripts.Count; i++)
            {
                var heard = Scripts[i].Messages;
                if (heard.IsStarted || !heard.IsOn) continue;
                heard.IsStarted = true;
                heard.Send(Message.Start);
            }
        }

        static void Send(Message message)
        {
            for (var i = 0; i < Scripts.Count; i++)
                if (Scripts[i].Messages.IsOn)
                    Scripts[i].Messages.Send(message);
        }

        static void Initialize(Assembly assembly)
        {
            foreach (var kind in assembly.GetTypes())
                foreach (var method in kind.GetMethods(BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic))
                    if (method.GetCustomAttributes(typeof(RuntimeInitializeOnLoadMethodAttribute), false).Length > 0)
                        method.Invoke(null, null);
        }
    }

    public static class Time
    {
        public static float deltaTime { get; internal set; }
        public static float fixedDeltaTime { get; set; } = 0.02f;
        public static float maximumDeltaTime { get; set; } = 1 / 3f;
        public static int frameCount { get; internal set; }
        public static float time { get; internal set; }
        public static float fixedTime { get; internal set; }

        internal static void Begin()
        {
            frameCount = 0;
            time = fixedTime = 0;
        }
    }

    public static class Debug
    {
        /// <summary>What was told, for tests. Not part of Unity.</summary>
        public static readonly List<string> Told = new List<string>();

        public static void Log(object message)
        {
            Console.WriteLine(message);
        }

        public static void LogWarning(object message)
        {
            Told.Add(message.ToString());
        }

        public static void LogError(object message, Object context)
        {
            Told.Add(message.ToString());
        }

        public static void LogException(Exception exception, Object context)
        {
            Told.Add(exception.Message);
        }
    }

    /// <summary>A mouse that rests, and whose button is down if it is set so.</summary>
    public class Input
    {
        /// <summary>Not part of Unity.</summary>
        public static bool Held;

        static int since = -1;

        public static Vector3 mousePosition => Vector3.zero;

        public static bool GetMouseButton(int button)
        {
            if (!Held) since = -1;
            else if (since < 0) since = Time.frameCount;
            return Held;
        }

        public static bool GetMouseButtonDown(int button)
        {
            return GetMouseButton(button) && since == Time.frameCount;
        }
    }
}
