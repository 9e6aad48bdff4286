using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Pbmpm.Editor")]
[assembly: InternalsVisibleTo("Pbmpm.Tests")]
