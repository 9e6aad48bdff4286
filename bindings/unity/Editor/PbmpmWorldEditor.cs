using Pbmpm.Components;
using UnityEditor;
using UnityEngine;

namespace Pbmpm.Editing
{
    /// <summary>Shows the library's advice on the scene, and what its materials come to.</summary>
    [CustomEditor(typeof(PbmpmWorld))]
    public sealed class PbmpmWorldEditor : Editor
    {
        SceneTrial trial;

        public override void OnInspectorGUI()
        {
            DrawDefaultInspector();
            EditorGUILayout.Space();
            if (GUILayout.Button("Ask for advice")) trial = SceneTrial.Of((PbmpmWorld)target);
            if (trial != null) Show(trial);
        }

        static void Show(SceneTrial trial)
        {
            if (trial.Problem.Length > 0) EditorGUILayout.HelpBox(trial.Problem, MessageType.Error);
            EditorGUILayout.LabelField("Particles", trial.Particles.ToString());
            foreach (var one in trial.Acting) EditorGUILayout.LabelField(one.Key.name, SceneTrial.Describe(one.Value));
            foreach (var note in trial.Advice) EditorGUILayout.HelpBox(note, MessageType.Warning);
            if (trial.Problem.Length == 0 && trial.Advice.Count == 0) EditorGUILayout.HelpBox("The library has no objections.", MessageType.Info);
        }
    }
}
