using System;
using System.Threading.Tasks;
using Pbmpm.Components;
using UnityEditor;
using UnityEngine;

namespace Pbmpm.Editing
{
    /// <summary>Bakes a solid beside the editor, which goes on meanwhile. The library does not tell how far it is, so the bar only moves.</summary>
    [CustomEditor(typeof(PbmpmSolid))]
    public sealed class PbmpmSolidEditor : Editor
    {
        Baking baking;

        public override void OnInspectorGUI()
        {
            DrawDefaultInspector();
            EditorGUILayout.Space();
            var solid = (PbmpmSolid)target;
            EditorGUILayout.LabelField("Baked", solid.IsBaked ? solid.Bytes / 1024 + " KiB, " + solid.Size : "not yet");
            using (new EditorGUI.DisabledScope(baking != null && !baking.IsDone))
                if (GUILayout.Button("Bake")) baking = new Baking(solid);
            if (baking != null && baking.Problem.Length > 0) EditorGUILayout.HelpBox(baking.Problem, MessageType.Error);
        }
    }

    /// <summary>One bake under way.</summary>
    internal sealed class Baking
    {
        readonly PbmpmSolid solid;
        readonly int bar;
        Task<BakedSolid> work;

        public bool IsDone { get; private set; }
        public string Problem { get; private set; } = "";

        public Baking(PbmpmSolid solid)
        {
            this.solid = solid;
            bar = Progress.Start("Baking " + solid.name, null, Progress.Options.Indefinite);
            EditorApplication.update += Look;
            try
            {
                work = Task.Run(solid.Prepare());
            }
            catch (Exception problem)
            {
                End(problem);
            }
        }

        /// <summary>Asked by the editor again and again.</summary>
        internal void Look()
        {
            if (IsDone || !work.IsCompleted) return;
            if (work.IsFaulted)
            {
                End(work.Exception.InnerException);
                return;
            }
            if (solid != null) // it may have been deleted meanwhile
            {
                solid.Keep(work.Result);
                EditorUtility.SetDirty(solid);
                AssetDatabase.SaveAssets();
            }
            End(null);
        }

        void End(Exception problem)
        {
            if (problem != null) Problem = problem.Message;
            IsDone = true;
            EditorApplication.update -= Look;
            Progress.Remove(bar);
        }
    }
}
